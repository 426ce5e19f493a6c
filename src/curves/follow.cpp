#include "curves/follow.hpp"

#include <algorithm>
#include <cmath>

#include "curves/branch_event.hpp"
#include "curves/motion_events.hpp"
#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

PlanePoint minus(const PlanePoint& a, const PlanePoint& b) {
    return {a.column - b.column, a.row - b.row};
}

class Follower {
  public:
    Follower(const Rig& rig, const OrbitPoint& stable, const PlanePoint& target, const PlanePoint& window)
        : begin_(stable.place),
          way_(minus(target, stable.place)),
          window_(window),
          stepper_(rig, window,
                   {Condition::on_line(stable.place, {-way_.row / size(), way_.column / size()})}) {
        stepper_.set_step(length() / 3);
    }

    FollowedOrbit run(const OrbitPoint& stable, const StepVisitor& look) {
        const int most_steps = look ? 4000 : 300;
        Stepper::Here here = stepper_.at(stable);
        if (progress_along(here) < 0) here.tangent = -here.tangent;
        for (int step = 0; step < most_steps; ++step) {
            const auto next = stepper_.next(here, look ? longest_along(here) : std::max(0.02, length() / 2));
            FollowedOrbit lost{false, {}, here.point.place};
            if (!next) return lost;
            Stepper::Here there = *next;
            const OrbitFault fault = find_fault(stepper_.rig(), there.point);
            const BranchEvent judged = judge(stepper_, here.point, there.point, fault);
            if (judged.seed) {
                if (look) static_cast<void>(look(here.point, there.point, judged.seed->point.place));
                return {false, judged.seed, judged.seed->point.place};
            }
            const bool too_long = judged.lost || (fault.kind == OrbitFault::Kind::pattern &&
                                                  !change_events(stepper_, here, there, longest_change));
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
    [[nodiscard]] double size() const { return std::max(std::abs(way_.column), std::abs(way_.row)); }
    [[nodiscard]] PlanePoint in_window(const PlanePoint& step) const {
        return {step.column / window_.column, step.row / window_.row};
    }
    [[nodiscard]] double length() const {
        const PlanePoint way = in_window(way_);
        return std::hypot(way.column, way.row);
    }
    [[nodiscard]] double progress_of(const PlanePoint& share) const {
        const PlanePoint way = in_window(way_);
        return (share.column * way.column + share.row * way.row) / (length() * length());
    }
    // 0 at the beginning, 1 at the target.
    [[nodiscard]] double progress(const PlanePoint& place) const {
        return progress_of(in_window(minus(place, begin_)));
    }
    [[nodiscard]] double progress_along(const Stepper::Here& here) const {
        return progress_of(Stepper::along(here.tangent));
    }

    // The longest step for which the place moves by at most a fixed share of the window.
    [[nodiscard]] static double longest_along(const Stepper::Here& here) {
        const PlanePoint along = Stepper::along(here.tangent);
        return std::min(0.25, 0.02 / std::max(std::hypot(along.column, along.row), 1e-3));
    }

    // Where a renewed contact is born, it may be an impact of its own soon after.
    static constexpr double longest_change = 1e-4;

    PlanePoint begin_;
    PlanePoint way_;
    PlanePoint window_;
    Stepper stepper_;
};

}  // namespace

FollowedOrbit follow(const Rig& rig, const OrbitPoint& stable, const PlanePoint& target,
                     const PlanePoint& window, const StepVisitor& look) {
    return Follower(rig, stable, target, window).run(stable, look);
}

std::optional<OrbitPoint> stable_orbit_near(const Rig& rig, const PlanePoint& place, const State<double>& state,
                                            std::int64_t period, const PlanePoint& window) {
    const auto orbit = orbit_from(rig, place, state, period);
    if (!orbit) return std::nullopt;
    auto found = solve(rig, {*orbit, place}, window,
                       {Condition::on_line(place, {1, 0}), Condition::on_line(place, {0, 1})});
    if (!found || find_fault(rig, *found).kind != OrbitFault::Kind::none) return std::nullopt;
    if (!monodromy(rig, found->orbit, found->place, {}).is_stable()) return std::nullopt;
    return found;
}

}  // namespace peterka::curves
