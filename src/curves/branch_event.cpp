#include "curves/branch_event.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "curves/merging.hpp"
#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

double bifurcation_of(const Stepper& stepper, const OrbitPoint& point, int sign) {
    return smooth_bifurcation(stepper.rig(), point.orbit, point.place, sign, Side::without_impact);
}

std::optional<OrbitPoint> crossing_of_multiplier(const Stepper& stepper, const OrbitPoint& from,
                                                 const OrbitPoint& to, int sign) {
    const double before = bifurcation_of(stepper, from, sign);
    const double after = bifurcation_of(stepper, to, sign);
    auto found = solve(stepper.rig(), between(from, to, before / (before - after)), stepper.window(),
                       stepper.conditions_and(Condition::at_multiplier(sign)));
    if (!found) return std::nullopt;
    // a different crossing, outside the step, may lie as close to the guess
    constexpr double rounding = 0.01;  // relative to the step, as the branch is curved
    const Eigen::VectorXd step = way_between(stepper.rig(), from, to, stepper.window());
    const Eigen::VectorXd way = way_between(stepper.rig(), from, *found, stepper.window());
    const double share = way.dot(step) / step.squaredNorm();
    if (share < -rounding || share > 1 + rounding || way.norm() > 2 * step.norm()) return std::nullopt;
    return found;
}

// A grazing within a step, and the branch's own point there, with the events that it has up to there.
struct Grazing {
    OrbitPoint motion;
    OrbitPoint end;
};

std::optional<Grazing> grazing_between(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to,
                                       const OrbitFault& fault) {
    const auto settle = [&](const OrbitPoint& guess) {
        return solve(stepper.rig(), guess, stepper.window(), stepper.conditions());
    };
    if (fault.kind == OrbitFault::Kind::pierces) {
        const auto grazing = settle(with_grazing(to, fault));
        if (!grazing || is_impact_before_it(stepper.rig(), *grazing)) return std::nullopt;
        return Grazing{*grazing, without_grazing(*grazing)};
    }
    const double before = from.orbit.events[fault.event].velocity;
    const double after = to.orbit.events[fault.event].velocity;
    const double share = before == after ? 1 : std::clamp(before / (before - after), 0.0, 1.0);
    const auto slow = solve(stepper.rig(), between(from, to, share), stepper.window(),
                            stepper.conditions_and(Condition::at_rest(fault.event)));
    if (!slow) return std::nullopt;
    const auto reshaped = grazing_in_place_of(stepper.rig(), *slow, fault.event);
    const auto grazing = reshaped ? settle(*reshaped) : std::nullopt;
    return grazing ? std::optional(Grazing{*grazing, *slow}) : std::nullopt;
}

// Whether a test function of equal sign at both ends of a step may vanish in between, judged by the parabola
// through the ends and the middle.
bool may_vanish(double from, double middle, double to) {
    constexpr double near = 0.2;  // of the smaller end value: the parabola is only an estimate
    const double ends = std::min(std::abs(from), std::abs(to));
    if ((from > 0) != (middle > 0)) return true;
    const double bend = std::copysign(1.0, from) * (from - 2 * middle + to);
    const double fall = std::copysign(1.0, from) * (3 * from - 4 * middle + to);
    if (!(bend > 0) || !(fall > 0) || fall > 4 * bend) return false;  // no minimum within the step
    return std::abs(from) - fall * fall / (8 * bend) < near * ends;
}

// Whether a step with no event at its end, or none but a grazing, may have passed over two that cancel: a
// period doubling and its reverse, or an impact gained and lost again.
bool may_hide_events(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to) {
    const auto middle = solve(stepper.rig(), between(from, to, 0.5), stepper.window(), stepper.conditions());
    if (!middle) return true;
    const OrbitFault::Kind fault = find_fault(stepper.rig(), *middle).kind;
    if (fault == OrbitFault::Kind::pierces || fault == OrbitFault::Kind::slow) return true;
    return std::ranges::any_of(std::array{1, -1}, [&](int sign) {
        return may_vanish(bifurcation_of(stepper, from, sign), bifurcation_of(stepper, *middle, sign),
                          bifurcation_of(stepper, to, sign));
    });
}

// The seed's point, whose motion has other events, with those; none if there is none.
std::optional<OrbitPoint> with_events_of_motion(const Stepper& stepper, const Seed& seed) {
    const auto changed = with_true_events(stepper.rig(), seed.point);
    if (!changed) return std::nullopt;
    if (is_same_motion(changed->orbit, seed.point.orbit)) return seed.point;  // but for rounding
    const auto found =
        solve(stepper.rig(), *changed, stepper.window(),
              seed.kind == CurveKind::grazing
                  ? stepper.conditions()
                  : stepper.conditions_and(Condition::at_multiplier(seed.kind == CurveKind::fold ? 1 : -1)));
    const bool sound = found && find_fault(stepper.rig(), *found).kind == OrbitFault::Kind::none;
    return sound ? found : std::nullopt;
}

// Reduces a seed to its smallest period: an orbit of twice the period that ends where its halves become equal
// ends at a period doubling, and a repeated orbit that grazes does so in each repetition.
std::optional<Seed> sound(const Stepper& stepper, const Seed& seed) {
    Seed result = seed;
    const OrbitPoint shortest = with_smallest_period(stepper.rig(), seed.point, 1e-4);
    const bool is_fold = seed.kind == CurveKind::fold;
    if (seed.kind != CurveKind::period_doubling && shortest.orbit.period < seed.point.orbit.period) {
        const auto found =
            solve(stepper.rig(), shortest, stepper.window(),
                  is_fold ? stepper.conditions_and(Condition::at_multiplier(-1)) : stepper.conditions());
        if (!found) return std::nullopt;
        result = {is_fold ? CurveKind::period_doubling : CurveKind::grazing, *found};
    }
    const OrbitFault::Kind fault = find_fault(stepper.rig(), result.point).kind;
    if (fault == OrbitFault::Kind::pierces || fault == OrbitFault::Kind::slow) return std::nullopt;
    if (fault == OrbitFault::Kind::pattern) {
        const auto motion = with_events_of_motion(stepper, result);
        if (!motion) return std::nullopt;
        result.point = *motion;
    }
    return result;
}

}  // namespace

BranchEvent judge(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to,
                  const OrbitFault& fault) {
    BranchEvent judged;
    double nearest = std::numeric_limits<double>::infinity();
    const auto offer = [&](const std::optional<OrbitPoint>& point, CurveKind kind) {
        if (!point) {
            judged.lost = true;
            return;
        }
        const double distance = std::hypot((point->place.column - from.place.column) / stepper.window().column,
                                           (point->place.row - from.place.row) / stepper.window().row);
        if (distance >= nearest) return;
        nearest = distance;
        judged.seed = Seed{kind, *point};
    };
    // Beyond a grazing the branch is that of no motion: a multiplier may come back there from what it has
    // crossed before.
    std::optional<Grazing> grazing;
    if (fault.kind == OrbitFault::Kind::pierces || fault.kind == OrbitFault::Kind::slow) {
        grazing = grazing_between(stepper, from, to, fault);
        judged.lost = !grazing;
    }
    const OrbitPoint& end = grazing ? grazing->end : to;
    const bool merges = halves_meet(stepper, from, end);
    if (merges) offer(merging_orbit(stepper, from, end), CurveKind::period_doubling);
    bool passes_any = merges;
    for (const int sign : {1, -1}) {
        if (merges && sign > 0) continue;  // det(M - I) touches 0 at the merging; rounding may flip its sign
        if ((bifurcation_of(stepper, from, sign) > 0) == (bifurcation_of(stepper, end, sign) > 0)) continue;
        passes_any = true;
        offer(crossing_of_multiplier(stepper, from, end, sign),
              sign > 0 ? CurveKind::fold : CurveKind::period_doubling);
    }
    if (!passes_any) {
        if (grazing) offer(grazing->motion, CurveKind::grazing);
        judged.lost = judged.lost || may_hide_events(stepper, from, end);
    }
    if (judged.lost) judged.seed.reset();
    if (judged.seed) {
        judged.seed = sound(stepper, *judged.seed);
        judged.lost = !judged.seed;
    }
    return judged;
}

namespace {

// The point with its tangent, oriented along `ahead` in the plane.
Stepper::Here ahead_from(const Stepper& stepper, const OrbitPoint& point, const PlanePoint& ahead) {
    Stepper::Here here = stepper.at(point);
    const PlanePoint now = Stepper::along(here.tangent);
    if (now.column * ahead.column + now.row * ahead.row < 0) here.tangent = -here.tangent;
    return here;
}

double duration_at(const Stepper& stepper, const OrbitPoint& point) {
    return stepper.rig().at(point.place).duration_of(point.orbit.period);
}

// The next point, if its motion has the same events.
std::optional<Stepper::Here> same_events_after(const Stepper& stepper, const Stepper::Here& here) {
    Stepper ahead = stepper;
    const auto there = ahead.next(here, stepper.step());
    const bool same = there && !reversed_pair(stepper.rig(), there->point) &&
                      find_fault(stepper.rig(), there->point).kind != OrbitFault::Kind::pattern;
    return same ? there : std::nullopt;
}

constexpr double longest_at_turn = 1e-4;

// `here` has lost a pair of events, or others have changed. A branch goes on smoothly, but the multipliers
// beside the birth of a pair change as the square root of the distance, so that a curve of folds or period
// doublings may turn back there: with the other events it is on the same side. It then goes on where the motion
// keeps its events. So short a step must have led to the turn that a gap asked for is hardly passed over
// unseen. False if it wasn't, or if `here` itself doesn't have the events of its motion and there are none such
// beside it.
bool goes_on_from_birth(const Stepper& stepper, Stepper::Here& here) {
    const bool sound = find_fault(stepper.rig(), here.point).kind != OrbitFault::Kind::pattern;
    for (const bool turns : {false, true}) {
        Stepper::Here way = here;
        if (turns) way.tangent = -way.tangent;
        const auto there = same_events_after(stepper, way);
        if (!there) continue;
        if (turns && stepper.step() > longest_at_turn) return false;
        here = sound ? way : *there;
        return true;
    }
    return sound;
}

// `here`, reached from `from`, has gained a pair of events, beyond the birth or, where the curve turns back,
// before it. Either way it goes on where the pair lasts longer. False as above.
bool goes_on_with_pair(const Stepper& stepper, const OrbitPoint& from, Stepper::Here& here) {
    const Orbit& orbit = here.point.orbit;
    const double duration = duration_at(stepper, here.point);
    std::size_t pair = 0;
    for (std::size_t i = 1; i < orbit.events.size(); ++i) {
        if (orbit.length_of_leg(i, duration) < orbit.length_of_leg(pair, duration)) pair = i;
    }
    const auto length_after = [&](bool turns) {
        Stepper::Here way = here;
        if (turns) way.tangent = -way.tangent;
        Stepper ahead = stepper;
        const auto there = ahead.next(way, stepper.step());
        return there ? there->point.orbit.length_of_leg(pair, duration_at(stepper, there->point))
                     : -std::numeric_limits<double>::infinity();
    };
    const PlanePoint along = Stepper::along(here.tangent);
    const bool is_behind =
        stepper.plane_way(from, here.point).dot(Eigen::Vector2d(along.column, along.row)) < 0;
    const bool turns = length_after(true) > length_after(false);
    if ((turns || is_behind) && stepper.step() > longest_at_turn) return false;
    if (turns) here.tangent = -here.tangent;
    if (find_fault(stepper.rig(), here.point).kind != OrbitFault::Kind::pattern) return true;
    const auto there = same_events_after(stepper, here);
    if (there) here = *there;
    return there.has_value();
}

// Where a pair of events is born, the solutions of the equations turn back with the pair in reverse order: the
// branch continues without it.
bool leave_pair(const Stepper& stepper, const Stepper::Here& from, Stepper::Here& here, std::size_t pair) {
    const double length = from.point.orbit.length_of_leg(pair, duration_at(stepper, from.point));
    const double reversed = here.point.orbit.length_of_leg(pair, duration_at(stepper, here.point));
    if (!(length > 0)) return false;
    const OrbitPoint guess = without_pair(between(from.point, here.point, length / (length - reversed)), pair);
    if (guess.orbit.events.empty()) return false;  // the stop holds the hammer from then on
    const auto settled = solve(stepper.rig(), guess, stepper.window(), stepper.conditions());
    if (!settled) return false;
    here = ahead_from(stepper, *settled, Stepper::along(from.tangent));
    return goes_on_from_birth(stepper, here);
}

}  // namespace

bool change_events(const Stepper& stepper, const Stepper::Here& from, Stepper::Here& here,
                   double longest_step) {
    const PlanePoint ahead = Stepper::along(here.tangent);
    const bool is_short = stepper.step() <= longest_step;
    const auto pair = reversed_pair(stepper.rig(), here.point);
    if (pair && has_same_events(from.point.orbit, here.point.orbit))
        return is_short && leave_pair(stepper, from, here, *pair);
    const auto changed = with_true_events(stepper.rig(), here.point);
    if (changed && is_same_motion(changed->orbit, here.point.orbit))
        return true;  // the events differ by rounding only
    if (!is_short) return false;
    auto settled =
        changed ? solve(stepper.rig(), *changed, stepper.window(), stepper.conditions()) : std::nullopt;
    const auto mirrored = settled ? reversed_pair(stepper.rig(), *settled) : std::nullopt;
    if (mirrored) {
        settled = solve(stepper.rig(), with_pair_turned(stepper.rig(), *settled, *mirrored), stepper.window(),
                        stepper.conditions());
        if (settled && reversed_pair(stepper.rig(), *settled)) return false;
    }
    // an impact gained or lost implies a grazing that so long a step has passed over
    if (!settled || settled->orbit.impacts() != here.point.orbit.impacts()) return false;
    const auto unscaled = [&](const OrbitPoint& point, int sign) {
        return monodromy(stepper.rig(), point.orbit, point.place, Side::without_impact).bifurcation(sign);
    };
    for (const int sign : {1, -1}) {  // as does a multiplier past 1 or -1, except by rounding on its curve
        constexpr double rounding = 1e-6;
        const double before = unscaled(here.point, sign);
        const double after = unscaled(*settled, sign);
        if ((before > 0) != (after > 0) && std::max(std::abs(before), std::abs(after)) > rounding) return false;
    }
    const bool gains = settled->orbit.events.size() > here.point.orbit.events.size();
    here = ahead_from(stepper, *settled, ahead);
    return gains ? goes_on_with_pair(stepper, from.point, here) : goes_on_from_birth(stepper, here);
}

}  // namespace peterka::curves
