#include "curves/trace_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "curves/branch_event.hpp"
#include "curves/gap_crossings.hpp"
#include "curves/inflection.hpp"
#include "curves/merging.hpp"
#include "curves/reshape.hpp"
#include "curves/stroboscopic.hpp"
#include "curves/turn_back.hpp"

namespace peterka::curves {

namespace {

struct MultiplierTest {
    int sign;
    Side side;
};
constexpr std::array<MultiplierTest, 4> multiplier_tests{
    {{1, Side::without_impact}, {-1, Side::without_impact}, {1, Side::with_impact}, {-1, Side::with_impact}}};

double dot(const PlanePoint& a, const PlanePoint& b) {
    return a.column * b.column + a.row * b.row;
}

// Half a curve: from the seed in one direction.
class HalfCurve {
  public:
    HalfCurve(const Rig& rig, const Seed& seed, const Window& window)
        : crossings({rig, window.size(), conditions_of(seed.kind)}, window, seed.kind),
          rig_(rig),
          kind_(seed.kind),
          window_(window),
          stepper_(rig, window.size(), conditions_of(seed.kind)) {}

    std::vector<CurvePoint> points;
    std::vector<Special> specials;
    GapCrossings crossings;
    CurveEnd end = CurveEnd::lost;

    void trace(const Stepper::Here& seed) {
        constexpr int most_points = 4000;
        Stepper::Here here = seed;
        for (int count = 0; count < most_points; ++count) {
            const double along = std::sqrt(dot(Stepper::along(here.tangent), Stepper::along(here.tangent)));
            auto there = stepper_.next(here, std::min(0.25, 0.012 / std::max(along, 1e-3)));
            if (!there) return;
            const Step step = judge(here, *there);
            if (step == Step::ends) return;
            if (step == Step::unclear) {
                if (stepper_.step() < 1e-6) return;
                stepper_.set_step(stepper_.step() / 8);
                continue;
            }
            if (count > 4 && closes(seed, here, *there)) {
                const auto last = told_like(rig_, seed.point, here.point.orbit);
                if (last) {
                    const Stepper::Here end_point = stepper_.at(*last, here.tangent);
                    look_for_specials(here, end_point);
                    crossings.look(end_point, here.point);  // the first point is told already
                }
                keep(seed.point);
                end = CurveEnd::closed;
                return;
            }
            look_for_specials(here, *there);
            crossings.look(here, there->point);
            if (bounds_nothing(there->point)) return end_at_last_special();
            keep_on_the_way(there->point);
            here = *there;
        }
    }

    // Whether no orbit beside a curve is stable. At a fold and a period doubling one of them always is, since
    // the other multiplier lies inside the unit circle.
    [[nodiscard]] bool bounds_nothing(const OrbitPoint& point) const {
        if (kind_ != CurveKind::grazing) return false;
        return !stable(point, Side::without_impact) && (rig_.is_rigid() || !stable(point, Side::with_impact));
    }

    [[nodiscard]] bool stable(const OrbitPoint& point, Side side) const {
        return monodromy(rig_, point.orbit, point.place, side).is_stable();
    }

    [[nodiscard]] const Stepper& stepper() const { return stepper_; }

  private:
    void keep(const OrbitPoint& point) { points.push_back(curve_point(rig_, point, kind_)); }

    // But for those so close to an impact without speed that their multiplier is lost in rounding, and with it
    // their order: the end is kept.
    void keep_on_the_way(const OrbitPoint& point) {
        const CurvePoint kept = curve_point(rig_, point, kind_);
        if (kind_ == CurveKind::grazing || !std::isnan(kept.multiplier)) points.push_back(kept);
    }

    std::optional<OrbitPoint> solve_with(const OrbitPoint& guess, const Condition& condition) const {
        return solve(rig_, guess, window_.size(), stepper_.conditions_and(condition));
    }

    // A release at which the stop presses again at once solves the equations of a brief flight, too: then from
    // the true motion there.
    std::optional<OrbitPoint> solve_for_motion(const OrbitPoint& guess, const Condition& condition) const {
        auto found = solve_with(guess, condition);
        if (!found || find_fault(rig_, *found).kind != OrbitFault::Kind::pattern) return found;
        const auto motion = with_true_events(rig_, *found);
        const auto again = motion ? solve_with(*motion, condition) : motion;
        return again ? again : found;
    }

    enum class Step : std::uint8_t { goes_on, ends, unclear };

    // A step ends the curve at the border, or where another impact grazes. One too long for what it has met is
    // `unclear`.
    Step judge(const Stepper::Here& here, Stepper::Here& there) {
        if (kind_ == CurveKind::grazing && is_impact_before_it(rig_, there.point)) {
            end = CurveEnd::lost;
            return Step::ends;
        }
        if (kind_ == CurveKind::grazing && grazing_turns_over(rig_, here.point, there.point)) {
            const auto guess = with_brief_grazing(there.point);
            const auto last =
                guess ? solve_with(*guess, Condition::without_acceleration(guess->orbit.grazing())) : guess;
            if (!last || !window_.holds(last->place)) return Step::unclear;
            add_special(SpecialKind::inflection, *last);
            crossings.look(here, *last);
            end = CurveEnd::special;
            return Step::ends;
        }
        if (kind_ == CurveKind::fold && halves_meet(stepper_, here.point, there.point)) {
            const auto last = merging_fold(stepper_, here.point, there.point);
            if (!last || !window_.holds(last->place)) return Step::unclear;
            add_special(SpecialKind::generalized_flip, *last);
            crossings.look(here, *last);
            end = CurveEnd::special;
            return Step::ends;
        }
        const bool leaves = !window_.holds(there.point.place);
        const OrbitFault fault = find_fault(rig_, there.point);
        const bool breaks = fault.kind == OrbitFault::Kind::pierces || fault.kind == OrbitFault::Kind::slow;
        if (breaks && has_same_events(here.point.orbit, there.point.orbit)) {
            const auto last = other_grazing(here.point, there.point, fault);
            if (last && meets_another(*last, fault)) return Step::unclear;
            if (last && window_.holds(last->place)) {
                add_special(kind_ == CurveKind::fold
                                ? SpecialKind::fold_grazing
                                : (kind_ == CurveKind::grazing ? SpecialKind::double_grazing
                                                               : SpecialKind::flip_grazing),
                            *last);
                crossings.look(here, *last);
                end = CurveEnd::special;
                return Step::ends;
            }
            if (!last && !leaves) return Step::unclear;
        }
        if (leaves) {
            const auto last = at_border(here.point, there.point);
            if (last) {
                keep(*last);
                crossings.look(here, *last);
            }
            end = last || !window_.holds(here.point.place, -1e-9) ? CurveEnd::border : CurveEnd::lost;
        }
        if (leaves || breaks) return Step::ends;
        return fault.kind != OrbitFault::Kind::pattern || change_events(stepper_, here, there) ? Step::goes_on
                                                                                               : Step::unclear;
    }

    std::optional<OrbitPoint> at_border(const OrbitPoint& here, const OrbitPoint& there) const {
        double share = 1;
        Condition border;
        const auto meet = [&](double from, double to, double line, const PlanePoint& through,
                              const PlanePoint& normal) {
            if ((from - line) * (to - line) >= 0) return;
            const double at = (line - from) / (to - from);
            if (at > share) return;
            share = at;
            border = Condition::on_line(through, normal);
        };
        for (const PlanePoint& corner : {window_.low, window_.high}) {
            meet(here.place.column, there.place.column, corner.column, corner, {1, 0});
            meet(here.place.row, there.place.row, corner.row, corner, {0, 1});
        }
        if (border.normal.column == 0 && border.normal.row == 0) return std::nullopt;
        return solve_with(between(here, there, share), border);
    }

    std::optional<OrbitPoint> other_grazing(const OrbitPoint& here, const OrbitPoint& there,
                                            const OrbitFault& fault) const {
        if (fault.kind == OrbitFault::Kind::pierces) {
            const OrbitPoint guess = with_grazing(there, fault);
            return solve(rig_, guess, window_.size(), stepper_.conditions());
        }
        const double before = here.orbit.events[fault.event].velocity;
        const double after = there.orbit.events[fault.event].velocity;
        const double share = before == after ? 1 : std::clamp(before / (before - after), 0.0, 1.0);
        return solve_with(between(here, there, share), Condition::at_rest(fault.event));
    }

    // Whether the orbit of another grazing meets the stop once more, or has lost another impact: of two events
    // in a step, the one that is solved for may come second.
    [[nodiscard]] bool meets_another(OrbitPoint grazing, const OrbitFault& fault) const {
        constexpr double least = 1e-12;
        if (fault.kind == OrbitFault::Kind::slow) {  // its own impact, at rest
            Event& slow = grazing.orbit.events[fault.event];
            slow.velocity = slow.kind == EventKind::touch ? least : -least;
        }
        const OrbitFault::Kind other = find_fault(rig_, grazing).kind;
        return other == OrbitFault::Kind::pierces || other == OrbitFault::Kind::slow;
    }

    void add_special(SpecialKind kind, const OrbitPoint& point) {
        specials.push_back({kind, point.place});
        keep(point);
    }

    void look_for_specials(const Stepper::Here& here, const Stepper::Here& there) {
        const bool same_events = has_same_events(here.point.orbit, there.point.orbit);
        if (kind_ == CurveKind::fold && same_events) look_for_cusp(here, there);
        if (kind_ != CurveKind::grazing) return;
        for (const MultiplierTest& test : multiplier_tests) {
            if (test.side == Side::with_impact && rig_.is_rigid()) continue;
            const auto value = [&](const OrbitPoint& point) {
                return monodromy(rig_, point.orbit, point.place, test.side).bifurcation(test.sign);
            };
            const double before = value(here.point);
            const double after = value(there.point);
            if ((before > 0) == (after > 0)) continue;
            const auto found = solve_for_motion(
                same_events ? between(here.point, there.point, before / (before - after)) : there.point,
                Condition::at_multiplier(test.sign, test.side));
            if (found)
                add_special(test.sign > 0 ? SpecialKind::fold_grazing : SpecialKind::flip_grazing, *found);
        }
    }

    // At a cusp a curve turns back in the plane, while its orbits continue smoothly (Kuznetsov 2004, ch. 9).
    void look_for_cusp(const Stepper::Here& here, const Stepper::Here& there) {
        const PlanePoint before = Stepper::along(here.tangent);
        if (dot(before, Stepper::along(there.tangent)) > 0) return;
        const auto cusp = last_before_turn(stepper_, here, there.point, [&](const Eigen::VectorXd& tangent) {
            return dot(before, Stepper::along(tangent));
        });
        if (cusp) add_special(SpecialKind::cusp, *cusp);
    }

    void end_at_last_special() { end = specials.empty() ? CurveEnd::lost : CurveEnd::special; }

    // Whether a step passes the seed.
    bool closes(const Stepper::Here& seed, const Stepper::Here& here, const Stepper::Here& there) const {
        const auto before = told_like(rig_, here.point, seed.point.orbit);
        if (!before) return false;
        const auto now = told_like(rig_, there.point, before->orbit);
        if (!now) return false;
        const Eigen::VectorXd from = way_between(rig_, seed.point, *before, window_.size());
        const Eigen::VectorXd to = way_between(rig_, seed.point, *now, window_.size());
        return from.dot(seed.tangent) < 0 && to.dot(seed.tangent) >= 0 && to.norm() < (to - from).norm() * 1.5;
    }

    const Rig& rig_;
    CurveKind kind_;
    Window window_;
    Stepper stepper_;
};

// NaN where a curve ends at an impact without speed on a rigid stop: there M is infinite, and close by lost in
// rounding, while what defines the curve is not.
double told_multiplier(double multiplier, CurveKind kind) {
    constexpr double rounding = 1e-6;
    if (kind == CurveKind::grazing) return multiplier;
    const double sign = kind == CurveKind::fold ? 1 : -1;
    return std::abs(multiplier - sign) < rounding ? multiplier : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

CurvePoint curve_point(const Rig& rig, const OrbitPoint& point, CurveKind kind) {
    const Monodromy product = monodromy(rig, point.orbit, point.place, Side::without_impact);
    CurvePoint result;
    result.impacts = point.orbit.impacts();
    result.place = point.place;
    result.orbit = point.orbit;
    result.multiplier = told_multiplier(product.multiplier(), kind);
    result.peak_force = peak_force(rig, point);
    result.residual = residual(point, equations(rig, point, conditions_of(kind)));
    result.at_phase_0 = stroboscopic_states(rig, point).front().state;
    result.trace = product.matrix.trace();
    for (const Event& event : point.orbit.events) {
        if (event.kind == EventKind::touch) result.total_speed += event.velocity;
    }
    return result;
}

namespace {

// A curve may come back on itself where the stop begins to release within a contact.
bool is_told(const std::vector<Crossing>& told, const Crossing& crossing, const Window& window) {
    constexpr double same = 1e-9;  // of the window
    return std::ranges::any_of(told, [&](const Crossing& other) {
        return std::abs(other.place.column - crossing.place.column) < same * window.size().column &&
               std::abs(other.place.row - crossing.place.row) < same * window.size().row;
    });
}

}  // namespace

Curve trace_curve(const Rig& rig, const Seed& seed, const Window& window) {
    Curve curve;
    curve.kind = seed.kind;
    HalfCurve forward(rig, seed, window);
    if (forward.bounds_nothing(seed.point) || !window.holds(seed.point.place)) return curve;
    const bool counts = seed.kind == CurveKind::grazing && !forward.stable(seed.point, Side::without_impact);
    curve.impacts = seed.point.orbit.impacts() + (counts ? 1 : 0);
    curve.period = seed.point.orbit.period;

    Stepper::Here start = forward.stepper().at(seed.point);
    forward.crossings.look(start, seed.point);
    forward.trace(start);
    HalfCurve backward(rig, seed, window);
    if (forward.end != CurveEnd::closed) {
        start.tangent = -start.tangent;
        backward.trace(start);
    }
    curve.begins = forward.end == CurveEnd::closed ? CurveEnd::closed : backward.end;
    curve.ends = forward.end;
    curve.points.assign(backward.points.rbegin(), backward.points.rend());
    curve.points.push_back(curve_point(rig, seed.point, seed.kind));
    curve.points.insert(curve.points.end(), forward.points.begin(), forward.points.end());
    curve.specials = backward.specials;
    for (const HalfCurve* half : {&backward, &forward}) {
        for (const Crossing& crossing : half->crossings.found()) {
            if (!is_told(curve.crossings, crossing, window)) curve.crossings.push_back(crossing);
        }
    }
    curve.specials.insert(curve.specials.end(), forward.specials.begin(), forward.specials.end());
    return curve;
}

}  // namespace peterka::curves
