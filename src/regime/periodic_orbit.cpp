#include "regime/periodic_orbit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace peterka::regime {

namespace {

constexpr int newton_steps = 8;              // quadratic convergence needs 3 to 5 from a recurrence within 0.1
constexpr double newton_residual = 1e-11;    // relative; some thousand times the rounding error of a cycle
constexpr double largest_stable = 1 - 1e-9;  // closer to 1 than rounding allows to tell from a bifurcation
// Near a stable orbit; farther away Newton's method leads to one that isn't.
constexpr double largest_stretch = 1.2;
constexpr double nearness = 1e-3;  // a divisor's orbit must lie this close to the orbit that it replaces

// A residual below this falls to rounding with one more step.
constexpr double nearly_there = 1e-8;

bool lie_together(const Point& there, const Point& here) {
    return (there - here).lpNorm<Eigen::Infinity>() <= nearness * magnitude(here);
}

bool returns_after(const PeriodicOrbit& orbit, std::int64_t cycles) {
    return lie_together(orbit.points[static_cast<std::size_t>(cycles)], orbit.point);
}

}  // namespace

bool is_stable(const PeriodicOrbit& orbit) {
    return orbit.multiplier < largest_stable;
}

bool has_smaller_period(const PeriodicOrbit& orbit) {
    for (std::int64_t divisor = 1; divisor < orbit.period; ++divisor) {
        if (orbit.period % divisor == 0 && returns_after(orbit, divisor)) return true;
    }
    return false;
}

std::optional<Point> newton_step(const Point& from, const Point& end, const Eigen::Matrix2d& jacobian) {
    const Eigen::Matrix2d system = Eigen::Matrix2d::Identity() - jacobian;
    const Point correction = system.partialPivLu().solve(end - from);
    if (!correction.allFinite() || correction.lpNorm<Eigen::Infinity>() > magnitude(from)) return std::nullopt;
    return from + correction;
}

// Newton's method on M^q(x) = x. It goes on until rounding stops it, so the point is better than the residual
// asked for.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Point guess, std::int64_t q,
                                              double most_stretch) {
    PeriodicOrbit orbit;
    orbit.point = guess;
    orbit.period = q;
    const double residual_asked = std::max(newton_residual, 10 * map.noise());
    double last_size = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= newton_steps; ++step) {
        orbit.points.clear();
        orbit.jacobian.setIdentity();
        orbit.pattern = 0;
        orbit.touched = false;
        Point end = orbit.point;
        for (std::int64_t n = 0; n < q; ++n) {
            orbit.points.push_back(end);
            const Passage cycle = co_await map.cycle(end);
            if (!cycle.ok) co_return std::nullopt;
            end = cycle.end;
            orbit.jacobian = (cycle.jacobian * orbit.jacobian).eval();
            orbit.pattern = append(orbit.pattern, cycle.pattern);
            orbit.touched |= cycle.touched;
        }
        if (step == 0 && spectral_radius(orbit.jacobian) > most_stretch) co_return std::nullopt;
        const double size = (end - orbit.point).lpNorm<Eigen::Infinity>() / magnitude(orbit.point);
        const bool small = size < residual_asked;
        const bool is_best = size > last_size / 2 || size < 1e-15 || last_size < nearly_there;
        if (small && (is_best || step == newton_steps)) {
            orbit.multiplier = spectral_radius(orbit.jacobian);
            co_return orbit;
        }
        last_size = size;
        const auto next = newton_step(orbit.point, end, orbit.jacobian);
        if (!next) co_return std::nullopt;
        orbit.point = *next;
    }
    co_return std::nullopt;
}

Task<std::optional<PeriodicOrbit>> find_stable_orbit(StroboscopicMap& map, const Recurrence& trajectory,
                                                     std::int64_t q) {
    const auto guess = newton_step(trajectory.state(q), trajectory.state(), trajectory.jacobian(q));
    auto found = co_await find_orbit(map, guess.value_or(trajectory.state()), q, largest_stretch);
    if (!found || found->pattern != trajectory.pattern(q)) co_return std::nullopt;
    // Where a multiplier is near -1 the trajectory returns after 2q cycles before it returns after q.
    for (std::int64_t divisor = 1; divisor < q; ++divisor) {
        if (q % divisor != 0 || !returns_after(*found, divisor)) continue;
        auto smaller = co_await find_orbit(map, found->point, divisor, largest_stretch);
        if (!smaller || !lie_together(smaller->point, found->point)) continue;
        if (is_stable(*smaller) && smaller->pattern == trajectory.pattern(divisor)) co_return smaller;
    }
    if (!is_stable(*found)) co_return std::nullopt;
    co_return found;
}

ConvergenceTest::ConvergenceTest(const PeriodicOrbit& orbit, const Point& state, double noise)
    : orbit_(orbit),
      norm_(orbit.jacobian, orbit.multiplier),
      at_rest_(std::max(1e-9, 100 * noise) * magnitude(orbit.point)),
      error_(state - orbit.point) {}

ConvergenceTest::Verdict ConvergenceTest::advance(const Point& state, EventPattern pattern) {
    constexpr int needed_in_a_row = 2;
    constexpr int allowed_failures = 12;

    const Point before = error_;
    error_ = state - orbit_.point;
    if (pattern != orbit_.pattern) return Verdict::refuted;
    const double remainder = norm_(error_ - orbit_.jacobian * before);
    const bool at_rest =
        std::max(before.lpNorm<Eigen::Infinity>(), error_.lpNorm<Eigen::Infinity>()) < at_rest_;
    if (at_rest || remainder <= (1 - norm_.contraction()) / 2 * norm_(before)) {
        return ++in_a_row_ >= needed_in_a_row ? Verdict::proved : Verdict::open;
    }
    in_a_row_ = 0;
    const bool grows = norm_(error_) > norm_(before);
    return grows || ++failures_ >= allowed_failures ? Verdict::refuted : Verdict::open;
}

}  // namespace peterka::regime
