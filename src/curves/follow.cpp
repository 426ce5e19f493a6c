#include "curves/follow.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "curves/motion_events.hpp"
#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

Place minus(const Place& a, const Place& b) {
    return {a.frequency - b.frequency, a.gap - b.gap};
}

// What a multiplier has done between two points of a branch.
std::optional<OrbitPoint> crossing_of_multiplier(const Stepper& stepper, const OrbitPoint& from,
                                                 const OrbitPoint& to, int sign) {
    const double before =
        monodromy(stepper.rig(), from.orbit, from.place, Side::without_impact).bifurcation(sign);
    const double after = monodromy(stepper.rig(), to.orbit, to.place, Side::without_impact).bifurcation(sign);
    if ((before > 0) == (after > 0)) return std::nullopt;
    return solve(stepper.rig(), between(from, to, before / (before - after)), stepper.window(),
                 stepper.conditions_and(Condition::at_multiplier(sign)));
}

std::optional<OrbitPoint> grazing_between(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to,
                                          const Fault& fault) {
    const auto settle = [&](const OrbitPoint& guess) {
        return solve(stepper.rig(), guess, stepper.window(), stepper.conditions());
    };
    if (fault.kind == Fault::Kind::pierces) return settle(with_grazing(to, fault));
    const double before = from.orbit.events[fault.event].velocity;
    const double after = to.orbit.events[fault.event].velocity;
    const double share = before == after ? 1 : std::clamp(before / (before - after), 0.0, 1.0);
    const auto slow = solve(stepper.rig(), between(from, to, share), stepper.window(),
                            stepper.conditions_and(Condition::at_rest(fault.event)));
    if (!slow) return std::nullopt;
    const auto reshaped = grazing_in_place_of(stepper.rig(), *slow, fault.event);
    return reshaped ? settle(*reshaped) : std::nullopt;
}

class Follower {
  public:
    Follower(const Rig& rig, const OrbitPoint& stable, const Place& target, const Place& window)
        : begin_(stable.place),
          way_(minus(target, stable.place)),
          window_(window),
          stepper_(rig, window,
                   {Condition::on_line(stable.place, {-way_.gap / size(), way_.frequency / size()})}) {
        stepper_.set_step(length() / 3);
    }

    Followed run(const OrbitPoint& stable) {
        constexpr int most_steps = 300;
        Stepper::Here here = stepper_.at(stable);
        if (progress_along(here) < 0) here.tangent = -here.tangent;
        for (int step = 0; step < most_steps; ++step) {
            const auto next = stepper_.next(here, std::max(0.02, length() / 2));
            if (!next) return {};
            Stepper::Here there = *next;
            const Fault fault = find_fault(stepper_.rig(), there.point);
            const Judged judged = judge(here.point, there.point, fault);
            if (judged.seed) return {false, judged.seed};
            if (judged.lost) {
                if (stepper_.step() < 1e-6) return {};
                stepper_.set_step(stepper_.step() / 8);
                continue;
            }
            if (fault.kind == Fault::Kind::pattern && !change_events(there)) return {};
            if (progress(there.point.place) >= 1) return {true, {}};
            here = there;
        }
        return {};
    }

  private:
    struct Judged {
        std::optional<Seed> seed;
        bool lost = false;  // something happened, but it isn't known what
    };

    [[nodiscard]] double size() const { return std::max(std::abs(way_.frequency), std::abs(way_.gap)); }
    [[nodiscard]] Place in_window(const Place& step) const {
        return {step.frequency / window_.frequency, step.gap / window_.gap};
    }
    [[nodiscard]] double length() const {
        const Place way = in_window(way_);
        return std::hypot(way.frequency, way.gap);
    }
    [[nodiscard]] double progress_of(const Place& share) const {
        const Place way = in_window(way_);
        return (share.frequency * way.frequency + share.gap * way.gap) / (length() * length());
    }
    // 0 at the beginning, 1 at the target.
    [[nodiscard]] double progress(const Place& place) const {
        return progress_of(in_window(minus(place, begin_)));
    }
    [[nodiscard]] double progress_along(const Stepper::Here& here) const {
        return progress_of(Stepper::along(here.tangent));
    }

    [[nodiscard]] Judged judge(const OrbitPoint& from, const OrbitPoint& to, const Fault& fault) const {
        Judged judged;
        double nearest = std::numeric_limits<double>::infinity();
        const auto offer = [&](const std::optional<OrbitPoint>& point, CurveKind kind) {
            if (!point) {
                judged.lost = true;
                return;
            }
            const Place step = in_window(minus(point->place, from.place));
            const double distance = std::hypot(step.frequency, step.gap);
            if (distance >= nearest) return;
            nearest = distance;
            judged.seed = Seed{kind, *point};
        };
        for (const int sign : {1, -1}) {
            const double before = monodromy(stepper_.rig(), from.orbit, from.place, {}).bifurcation(sign);
            const double after = monodromy(stepper_.rig(), to.orbit, to.place, {}).bifurcation(sign);
            if ((before > 0) == (after > 0)) continue;
            offer(crossing_of_multiplier(stepper_, from, to, sign),
                  sign > 0 ? CurveKind::fold : CurveKind::period_doubling);
        }
        if (fault.kind == Fault::Kind::pierces || fault.kind == Fault::Kind::slow) {
            offer(grazing_between(stepper_, from, to, fault), CurveKind::grazing);
        }
        if (judged.lost) judged.seed.reset();
        if (judged.seed) judged.seed = sound(*judged.seed, judged.lost);
        return judged;
    }

    // An orbit of twice the period that ends where its halves become equal ends at a period doubling; and one
    // that repeats itself where it grazes does so in each of its parts.
    [[nodiscard]] std::optional<Seed> sound(const Seed& seed, bool& lost) const {
        Seed result = seed;
        const OrbitPoint shortest = with_smallest_period(seed.point, 1e-4);
        const bool is_fold = seed.kind == CurveKind::fold;
        if (seed.kind != CurveKind::period_doubling && shortest.orbit.period < seed.point.orbit.period) {
            const auto found =
                solve(stepper_.rig(), shortest, window_,
                      is_fold ? stepper_.conditions_and(Condition::at_multiplier(-1)) : stepper_.conditions());
            lost = !found;
            if (lost) return std::nullopt;
            result = {is_fold ? CurveKind::period_doubling : CurveKind::grazing, *found};
        }
        const Fault::Kind fault = find_fault(stepper_.rig(), result.point).kind;
        lost = fault == Fault::Kind::pierces || fault == Fault::Kind::slow;
        if (lost) return std::nullopt;
        return result;
    }

    bool change_events(Stepper::Here& here) {
        const Place ahead = Stepper::along(here.tangent);
        const auto changed = with_true_events(stepper_.rig(), here.point);
        if (changed && is_same_motion(changed->orbit, here.point.orbit))
            return true;  // by less than rounding tells
        const auto settled =
            changed ? solve(stepper_.rig(), *changed, window_, stepper_.conditions()) : std::nullopt;
        if (!settled) return false;
        here = stepper_.at(*settled);
        const Place now = Stepper::along(here.tangent);
        if (now.frequency * ahead.frequency + now.gap * ahead.gap < 0) here.tangent = -here.tangent;
        return true;
    }

    Place begin_;
    Place way_;
    Place window_;
    Stepper stepper_;
};

}  // namespace

std::vector<Condition> conditions_of(CurveKind kind) {
    if (kind == CurveKind::fold) return {Condition::at_multiplier(1)};
    if (kind == CurveKind::period_doubling) return {Condition::at_multiplier(-1)};
    return {};
}

Followed follow(const Rig& rig, const OrbitPoint& stable, const Place& target, const Place& window) {
    return Follower(rig, stable, target, window).run(stable);
}

std::optional<OrbitPoint> stable_orbit_near(const Rig& rig, const Place& place, const State<double>& state,
                                            std::int64_t period, const Place& window) {
    const auto orbit = orbit_from(rig, place, state, period);
    if (!orbit) return std::nullopt;
    auto found = solve(rig, {*orbit, place}, window,
                       {Condition::on_line(place, {1, 0}), Condition::on_line(place, {0, 1})});
    if (!found || find_fault(rig, *found).kind != Fault::Kind::none) return std::nullopt;
    if (!monodromy(rig, found->orbit, found->place, {}).is_stable()) return std::nullopt;
    return found;
}

std::optional<Seed> reach_of_free_motion(const Rig& rig, double frequency, const Place& window) {
    const std::complex<double> impedance(1 - frequency * frequency, 2 * rig.damping_ratio() * frequency);
    const std::complex<double> response = frequency * frequency / impedance;
    const double swing = std::abs(response);
    if (!std::isfinite(swing)) return std::nullopt;
    const double top = (std::numbers::pi / 2 - std::arg(response)) / frequency;
    const OrbitPoint guess{{1, {{EventKind::graze, false, top, 0}}}, {frequency, swing}};
    const auto found = solve(rig, guess, window, {Condition::on_line({frequency, swing}, {1, 0})});
    if (!found) return std::nullopt;
    return Seed{CurveKind::grazing, *found};
}

}  // namespace peterka::curves
