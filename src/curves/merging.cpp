#include "curves/merging.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

// Whether both halves have the same kinds of events, without a grazing.
bool has_equal_kinds(const Orbit& orbit) {
    const std::size_t half = orbit.events.size() / 2;
    if (orbit.period % 2 != 0 || orbit.events.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < half; ++i) {
        if (orbit.events[i].kind == EventKind::graze) return false;
        if (orbit.events[i].kind != orbit.events[i + half].kind) return false;
    }
    return true;
}

// The orbit half a period later, with its times shifted back to the original interval.
OrbitPoint half_a_period_later(const Rig& rig, const OrbitPoint& point) {
    OrbitPoint later = point;
    std::vector<Event>& events = later.orbit.events;
    const auto half = static_cast<std::ptrdiff_t>(events.size() / 2);
    std::rotate(events.begin(), events.begin() + half, events.end());
    const double duration = rig.at(point.place).duration_of(point.orbit.period);
    for (std::ptrdiff_t i = 0; i < std::ssize(events); ++i) {
        events[static_cast<std::size_t>(i)].time += (i < half ? -duration : duration) / 2;
    }
    return later;
}

// The mean of both halves, which near the merging equals the orbit of q cycles up to the square of their
// difference.
OrbitPoint mean_of_halves(const Rig& rig, const OrbitPoint& point) {
    OrbitPoint mean = between(point, half_a_period_later(rig, point), 0.5);
    mean.orbit.period /= 2;
    mean.orbit.events.resize(mean.orbit.events.size() / 2);
    return mean;
}

// How far the second half is from the first, and the first from the second.
Eigen::VectorXd difference_of_halves(const Stepper& stepper, const OrbitPoint& point) {
    return way_between(stepper.rig(), point, half_a_period_later(stepper.rig(), point), stepper.window());
}

// Where the halves are equal, from points on both sides. Exchanged, they solve the same equations: the mean and
// the place change as the square of their difference. Of the nearest points, where the equations are singular,
// rounding errors are larger than what is left of the way.
OrbitPoint where_halves_meet(const Stepper& stepper, std::vector<OrbitPoint> beside) {
    constexpr double nearest = 0.01;
    constexpr double apart = 1.5;  // or errors are magnified
    const auto size_of = [&](const OrbitPoint& point) { return difference_of_halves(stepper, point).norm(); };
    std::ranges::sort(beside, std::ranges::greater{}, size_of);
    const auto too_near = std::ranges::find_if(
        beside.begin() + 1, beside.end(), [&](const OrbitPoint& point) { return size_of(point) < nearest; });
    beside.erase(too_near, beside.end());
    const double size = size_of(beside.back());
    const auto other = std::ranges::find_if(
        beside.rbegin(), beside.rend(), [&](const OrbitPoint& point) { return size_of(point) > apart * size; });
    if (other == beside.rend()) return mean_of_halves(stepper.rig(), beside.back());
    const double ratio = std::pow(size_of(*other) / size, 2);
    return between(mean_of_halves(stepper.rig(), *other), mean_of_halves(stepper.rig(), beside.back()),
                   ratio / (ratio - 1));
}

constexpr double equal_halves = 1e-6;  // norm of a difference, in scaled unknowns

}  // namespace

OrbitPoint twice(const Rig& rig, const OrbitPoint& point) {
    OrbitPoint result = point;
    result.orbit.period *= 2;
    const double duration = rig.at(point.place).duration_of(point.orbit.period);
    for (Event event : point.orbit.events) {
        event.time += duration;
        result.orbit.events.push_back(event);
    }
    return result;
}

bool halves_are_equal(const Stepper& stepper, const OrbitPoint& point) {
    return has_equal_kinds(point.orbit) && difference_of_halves(stepper, point).norm() < equal_halves;
}

bool halves_meet(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to) {
    if (!has_equal_kinds(from.orbit) || !has_same_events(from.orbit, to.orbit)) return false;
    if (halves_are_equal(stepper, from)) return false;  // the orbit of q cycles, followed twice over
    // a branch may have jumped to the orbit of q cycles
    return halves_are_equal(stepper, to) ||
           difference_of_halves(stepper, from).dot(difference_of_halves(stepper, to)) < 0;
}

std::optional<OrbitPoint> merging_orbit(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to) {
    auto found = solve(stepper.rig(), mean_of_halves(stepper.rig(), from), stepper.window(),
                       stepper.conditions_and(Condition::at_multiplier(-1)));
    if (!found) return std::nullopt;
    // it must lie within the step, at whose end the halves may have changed places
    const double step = way_between(stepper.rig(), from, to, stepper.window()).norm();
    const double distance =
        way_between(stepper.rig(), from, twice(stepper.rig(), *found), stepper.window()).norm();
    if (distance > 2 * step) return std::nullopt;
    return found;
}

std::optional<OrbitPoint> merging_fold(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to) {
    // Where halves are equal, orbits at a period doubling, followed twice over, solve the same equations:
    // Newton's method goes there from nearby.
    constexpr int most_halvings = 40;
    const Eigen::VectorXd apart = difference_of_halves(stepper, from);
    OrbitPoint low = from;
    OrbitPoint high = to;
    std::vector<OrbitPoint> beside{from};
    if (!halves_are_equal(stepper, to)) beside.push_back(to);
    for (int halving = 0; halving < most_halvings; ++halving) {
        // one of these may lie too near the merging, where Newton's method fails
        std::optional<OrbitPoint> middle;
        for (const double share : {0.5, 0.3, 0.7}) {
            middle = solve(stepper.rig(), between(low, high, share), stepper.window(), stepper.conditions());
            if (middle && has_same_events(middle->orbit, from.orbit)) break;
            middle.reset();
        }
        if (!middle || halves_are_equal(stepper, *middle)) break;
        (difference_of_halves(stepper, *middle).dot(apart) > 0 ? low : high) = *middle;
        beside.push_back(*middle);
    }
    const auto found = solve(stepper.rig(), where_halves_meet(stepper, beside), stepper.window(),
                             {Condition::at_multiplier(-1)});
    if (!found) return std::nullopt;
    const OrbitPoint twice_over = twice(stepper.rig(), *found);
    const double step = way_between(stepper.rig(), from, to, stepper.window()).norm();
    if (way_between(stepper.rig(), from, twice_over, stepper.window()).norm() > 2 * step) return std::nullopt;
    return twice_over;
}

}  // namespace peterka::curves
