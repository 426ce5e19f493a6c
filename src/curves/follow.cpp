#include "curves/follow.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "curves/branch_event.hpp"
#include "curves/motion_events.hpp"
#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

Place minus(const Place& a, const Place& b) {
    return {a.frequency - b.frequency, a.gap - b.gap};
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

    Followed run(const OrbitPoint& stable, const LookAtStep& look) {
        const int most_steps = look ? 4000 : 300;
        Stepper::Here here = stepper_.at(stable);
        if (progress_along(here) < 0) here.tangent = -here.tangent;
        for (int step = 0; step < most_steps; ++step) {
            const auto next = stepper_.next(here, look ? longest_along(here) : std::max(0.02, length() / 2));
            Followed lost{false, {}, here.point.place};
            if (!next) return lost;
            Stepper::Here there = *next;
            const Fault fault = find_fault(stepper_.rig(), there.point);
            const BranchEvent judged = judge(stepper_, here.point, there.point, fault);
            if (judged.seed) {
                if (look) static_cast<void>(look(here.point, there.point, judged.seed->point.place));
                return {false, judged.seed, judged.seed->point.place};
            }
            const bool too_long =
                judged.lost || (fault.kind == Fault::Kind::pattern && !change_events(stepper_, here, there));
            if (too_long || (look && !look(here.point, there.point, there.point.place))) {
                if (stepper_.step() < 1e-6) return lost;
                stepper_.set_step(stepper_.step() / 8);
                continue;
            }
            if (progress(there.point.place) >= 1) return {true, {}, there.point.place};
            here = there;
        }
        return {false, {}, here.point.place};
    }

  private:
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

    // So that the place moves by no more than a share of the window.
    [[nodiscard]] static double longest_along(const Stepper::Here& here) {
        const Place along = Stepper::along(here.tangent);
        return std::min(0.25, 0.02 / std::max(std::hypot(along.frequency, along.gap), 1e-3));
    }

    Place begin_;
    Place way_;
    Place window_;
    Stepper stepper_;
};

}  // namespace

Followed follow(const Rig& rig, const OrbitPoint& stable, const Place& target, const Place& window,
                const LookAtStep& look) {
    return Follower(rig, stable, target, window).run(stable, look);
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
