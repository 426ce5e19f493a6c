#include "regime/periodic_orbit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "regime/orbit_round.hpp"
#include "regime/same_orbit.hpp"

namespace peterka::regime {

namespace {

constexpr int newton_steps = 8;              // quadratic convergence needs 3 to 5 from a recurrence within 0.1
constexpr double nearly_there = 1e-7;        // a correction below this was the last one above rounding
constexpr double rounding = 1e-14;           // relative error of a cycle
constexpr double largest_stable = 1 - 1e-9;  // closer to 1, rounding hides a bifurcation
// Near a stable orbit; from farther away Newton's method leads to an unstable one.
constexpr double largest_stretch = 1.2;
constexpr double nearness = 1e-3;  // a divisor's orbit must lie this close to the orbit that it replaces

bool lie_together(const Point& there, const Point& here) {
    return (there - here).lpNorm<Eigen::Infinity>() <= nearness * magnitude(here);
}

bool returns_after(const PeriodicOrbit& orbit, std::int64_t cycles) {
    return lie_together(orbit.points[static_cast<std::size_t>(cycles)], orbit.point());
}

}  // namespace

bool is_stable(const PeriodicOrbit& orbit) {
    return orbit.multiplier < largest_stable;
}

bool has_smaller_period(const PeriodicOrbit& orbit) {
    for (std::int64_t divisor = 1; divisor < orbit.period(); ++divisor) {
        if (orbit.period() % divisor == 0 && returns_after(orbit, divisor)) return true;
    }
    return false;
}

std::size_t put_lowest_point_first(PeriodicOrbit& orbit) {
    Points& points = orbit.points;
    double lowest = points.front()[0];
    for (const Point& point : points) lowest = std::min(lowest, point[0]);
    auto first = points.end();
    for (auto point = points.begin(); point != points.end(); ++point) {
        if (!coincide((*point)[0], lowest)) continue;
        if (first == points.end() || (*point)[1] < (*first)[1]) first = point;
    }
    const std::ptrdiff_t before = first - points.begin();
    std::rotate(points.begin(), first, points.end());  // clang 14 has no std::ranges::rotate
    return static_cast<std::size_t>(before);
}

// Each correction is about the square of the previous one, times a factor from the map's curvature: so two of
// them predict the size of the next. Where rounding limits them, they no longer fall.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Points guess, double most_stretch) {
    PeriodicOrbit orbit;
    orbit.points = std::move(guess);
    const std::size_t q = orbit.points.size();
    const double small = std::max(nearly_there, 100 * map.noise());
    double last_size = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= newton_steps; ++step) {
        OrbitRound round(orbit.period());
        for (std::size_t n = 0; n < q; ++n) {
            const CycleResult cycle = co_await map.cycle(orbit.points[n]);
            if (!cycle.ok) co_return std::nullopt;
            round.add(cycle, orbit.points[(n + 1) % q]);
        }
        orbit.multiplier = spectral_radius(round.jacobian());
        if (step == 0 && orbit.multiplier > most_stretch) co_return std::nullopt;
        const auto size = round.correct(orbit.points);
        if (!size) co_return std::nullopt;
        const double fall = std::min(*size / last_size, 1.0);
        if (*size < small && (*size * fall * fall < rounding || fall > 0.5)) {
            orbit.jacobian = round.jacobian();
            orbit.pattern = round.pattern();
            orbit.touched = round.touched();
            orbit.error = *size;
            co_return orbit;
        }
        last_size = *size;
    }
    co_return std::nullopt;
}

Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Point guess, std::int64_t q) {
    Points points{guess};
    while (static_cast<std::int64_t>(points.size()) < q) {
        const CycleResult cycle = co_await map.cycle(points.back());
        if (!cycle.ok) co_return std::nullopt;
        points.push_back(cycle.end);
    }
    co_return co_await find_orbit(map, std::move(points));
}

Task<std::optional<PeriodicOrbit>> find_stable_orbit(StroboscopicMap& map, const Recurrence& trajectory,
                                                     std::int64_t q) {
    auto found = co_await find_orbit(map, trajectory.closed(q), largest_stretch);
    if (!found || found->pattern != trajectory.pattern(q)) co_return std::nullopt;
    // Where a multiplier is near -1 (flip) the trajectory returns after 2q cycles before it returns after q.
    for (std::int64_t divisor = 1; divisor < q; ++divisor) {
        if (q % divisor != 0 || !returns_after(*found, divisor)) continue;
        auto smaller = co_await find_orbit(
            map, {found->points.begin(), found->points.begin() + static_cast<std::ptrdiff_t>(divisor)},
            largest_stretch);
        if (!smaller || !lie_together(smaller->point(), found->point())) continue;
        if (is_stable(*smaller) && smaller->pattern == trajectory.pattern(divisor)) co_return smaller;
    }
    if (!is_stable(*found)) co_return std::nullopt;
    co_return found;
}

Task<bool> is_stable_orbit_near(StroboscopicMap& map, const Recurrence& trajectory, std::int64_t longest) {
    for (std::int64_t q = 1; q <= longest; ++q) {
        const auto orbit = co_await find_orbit(map, trajectory.closed(q, trajectory.closest_return(q)));
        if (orbit && is_stable(*orbit)) co_return true;
    }
    co_return false;
}

namespace {

double cross(const Point& a, const Point& b) {
    return a[0] * b[1] - a[1] * b[0];
}

// Whether a point lies in the hull of the origin and other points: in a triangle of the origin and two of them.
bool in_hull_with_origin(const Point& point, std::span<const Point> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double area = cross(points[i], points[j]);
            const double first = cross(point, points[j]) / area;
            const double second = cross(points[i], point) / area;
            if (first >= 0 && second >= 0 && first + second <= 1) return true;
        }
    }
    return false;
}

// Whether the multipliers are complex, or so nearly equal that a deviation may turn for a while as well.
bool may_turn(const Eigen::Matrix2d& jacobian) {
    const double half_trace = jacobian.trace() / 2;
    return 0.99 * half_trace * half_trace < jacobian.determinant();
}

}  // namespace

ConvergenceTest::ConvergenceTest(const PeriodicOrbit& orbit, const Point& state, double noise)
    : orbit_(orbit),
      norm_(orbit.jacobian, orbit.multiplier),
      at_rest_(std::max(1e-9, 100 * noise) * magnitude(orbit.point())),
      error_(state - orbit.point()) {}

ConvergenceTest::Standing ConvergenceTest::advance(const Point& state, EventPattern pattern) {
    constexpr int needed_in_a_row = 2;
    constexpr int allowed_failures = 12;
    constexpr std::size_t most_followed = 512;
    constexpr double little = 1e-3;  // of the first deviation is left: any direction is as good as tried

    const Point before = error_;
    error_ = state - orbit_.point();
    if (pattern != orbit_.pattern) return Standing::refuted;
    const double remainder = norm_(error_ - orbit_.jacobian * before);
    const bool at_rest =
        std::max(before.lpNorm<Eigen::Infinity>(), error_.lpNorm<Eigen::Infinity>()) < at_rest_;
    if (at_rest || remainder <= (1 - norm_.contraction()) / 2 * norm_(before)) {
        if (followed_from_.size() < most_followed) followed_from_.push_back(before);
        const bool stays = at_rest || !may_turn(orbit_.jacobian) ||
                           norm_(error_) < little * norm_(followed_from_.front()) ||
                           in_hull_with_origin(error_, followed_from_);
        return ++in_a_row_ >= needed_in_a_row && stays ? Standing::proved : Standing::open;
    }
    in_a_row_ = 0;
    followed_from_.clear();
    const bool grows = norm_(error_) > norm_(before);
    return grows || ++failures_ >= allowed_failures ? Standing::refuted : Standing::open;
}

ConvergenceTest::Standing ConvergenceTest::follow(const CycleResult& cycle) {
    pattern_ = append(pattern_, cycle.pattern);
    if (++followed_ < orbit_.period()) return Standing::open;
    followed_ = 0;
    return advance(cycle.end, std::exchange(pattern_, 0));
}

TestOfPast test_of_past(const Recurrence& trajectory, const PeriodicOrbit& orbit, double noise) {
    constexpr std::int64_t most_periods = 16;
    const std::int64_t q = orbit.period();
    const std::int64_t periods = std::min(most_periods, trajectory.whole_periods(q));
    TestOfPast past{ConvergenceTest(orbit, trajectory.state(periods * q), noise)};
    for (std::int64_t left = periods; left-- > 0;) {
        past.standing = past.test.advance(trajectory.state(left * q), trajectory.pattern(q, left * q));
        if (past.standing == ConvergenceTest::Standing::refuted)
            past.test = ConvergenceTest(orbit, trajectory.state(left * q), noise);
    }
    past.test.forgive();
    return past;
}

}  // namespace peterka::regime
