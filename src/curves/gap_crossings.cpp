#include "curves/gap_crossings.hpp"

#include <cmath>

#include "curves/reshape.hpp"
#include "curves/turn_back.hpp"

namespace peterka::curves {

void GapCrossings::look(const Stepper::Here& here, const OrbitPoint& there) {
    if (window_.gaps.empty()) return;
    const auto back = turn(here, there);
    if (back) look_between(here.point, *back);
    look_between(back ? *back : here.point, there);
}

// Where the curve turns back along the gap between two points: there it may meet a gap twice.
std::optional<OrbitPoint> GapCrossings::turn(const Stepper::Here& here, const OrbitPoint& there) const {
    if (!has_same_events(here.point.orbit, there.orbit)) return std::nullopt;
    const auto along = [&](const Eigen::VectorXd& tangent) {
        return coordinate(Stepper::along(tangent), window_.gap_axis);
    };
    if ((along(here.tangent) > 0) == (along(stepper_.at(there, here.tangent).tangent) > 0)) return std::nullopt;
    return last_before_turn(stepper_, here, there, along);
}

void GapCrossings::look_between(const OrbitPoint& here, const OrbitPoint& there) {
    for (const double gap : window_.gaps) {
        const double tiny = 1e-12 * coordinate(window_.size(), window_.gap_axis);
        const double before = gap_of(here) - gap;
        const double after = gap_of(there) - gap;
        const bool arrives = std::abs(after) <= tiny;
        if (!arrives && (std::abs(before) <= tiny || (before > 0) == (after > 0))) continue;
        const auto found = arrives ? motion_at(gap, there) : crossing(here, there, gap);
        if (!found) continue;
        const CurvePoint at = curve_point(stepper_.rig(), *found, kind_);
        const PlanePoint exactly = moved(at.place, window_.gap_axis, gap - gap_of(*found));
        found_.push_back({exactly, at.multiplier, at.peak_force, found->orbit});
    }
}

// Of points on different sides of a gap. Newton's method from either of them may go to a crossing beside them.
std::optional<OrbitPoint> GapCrossings::crossing(const OrbitPoint& here, const OrbitPoint& there,
                                                 double gap) const {
    const double share = (gap_of(here) - gap) / (gap_of(here) - gap_of(there));
    if (has_same_events(here.orbit, there.orbit)) {
        if (auto found = motion_at(gap, between(here, there, share))) return found;
    }
    OrbitPoint on_the_way = here;
    on_the_way.place = {std::lerp(here.place.column, there.place.column, share),
                        std::lerp(here.place.row, there.place.row, share)};
    for (const OrbitPoint& guess : {there, on_the_way, here}) {
        auto found = motion_at(gap, guess);
        if (found && lies_between(here, there, *found)) return found;
    }
    return std::nullopt;
}

// With the events of the true motion; none if it has a fault.
std::optional<OrbitPoint> GapCrossings::motion_at(double gap, const OrbitPoint& guess) const {
    const auto conditions = stepper_.conditions_and(
        Condition::on_line(moved({}, window_.gap_axis, gap), moved({}, window_.gap_axis, 1)));
    const auto solve_with = [&](const OrbitPoint& point) {
        return solve(stepper_.rig(), point, stepper_.window(), conditions);
    };
    auto found = solve_with(guess);
    if (!found || !has_other_events(*found)) return found;
    const auto changed = with_true_events(stepper_.rig(), *found);
    if (!changed || is_same_motion(changed->orbit, found->orbit)) return found;
    found = solve_with(*changed);
    return found && has_other_events(*found) ? std::nullopt : found;
}

bool GapCrossings::has_other_events(const OrbitPoint& point) const {
    return find_fault(stepper_.rig(), point).kind == OrbitFault::Kind::pattern;
}

// By its projection on the chord of a step, in the plane.
bool GapCrossings::lies_between(const OrbitPoint& here, const OrbitPoint& there,
                                const OrbitPoint& point) const {
    constexpr double rounding = 1e-6;
    const Eigen::Vector2d chord = stepper_.plane_way(here, there);
    const double share = stepper_.plane_way(here, point).dot(chord) / chord.squaredNorm();
    return share > -rounding && share < 1 + rounding;
}

}  // namespace peterka::curves
