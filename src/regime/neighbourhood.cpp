#include "regime/neighbourhood.hpp"

#include <Eigen/Cholesky>
#include <numbers>
#include <utility>

#include "regime/adapted_norm.hpp"

namespace peterka::regime {

namespace {

constexpr int samples = 24;             // on a boundary
constexpr double smallest = 1.0 / 256;  // smallest radius tried; smaller ones are hardly ever entered
constexpr double largest = 64;          // beyond any state of interest
constexpr int bisections = 3;           // of the factor 2 between a radius that shrinks and one that doesn't
constexpr double largest_multiplier =
    0.999;  // weaker orbits attract too slowly to distinguish from rounding and folds

// Follows a point for a whole period.
Task<CycleResult> go_round(StroboscopicMap& map, Point from, std::int64_t q) {
    CycleResult round = co_await map.cycle(from);
    for (std::int64_t n = 1; n < q && round.ok; ++n) {
        const CycleResult next = co_await map.cycle(round.end);
        round.ok = next.ok;
        round.end = next.end;
        round.jacobian = (next.jacobian * round.jacobian).eval();
        round.pattern = append(round.pattern, next.pattern);
    }
    co_return round;
}

struct Target {
    Point point;
    std::int64_t period;
    AdaptedNorm norm;
    EventPattern pattern;
};

Task<bool> shrinks(StroboscopicMap& map, Target target, double radius) {
    const Neighbourhood ellipse(target.point, target.norm.metric(), radius);
    const double into = (1 + target.norm.contraction()) / 2 * radius;
    for (int sample = 0; sample < samples; ++sample) {
        const Point from = ellipse.boundary(2 * std::numbers::pi * sample / samples);
        const CycleResult round = co_await go_round(map, from, target.period);
        if (!round.ok || round.pattern != target.pattern) co_return false;
        if (!(target.norm(round.end - target.point) <= into)) co_return false;
    }
    co_return true;
}

// 0 if none shrinks.
Task<double> largest_that_shrinks(StroboscopicMap& map, Target target) {
    double proved = 0;
    double failed = smallest;
    while (failed <= largest && co_await shrinks(map, target, failed)) {
        proved = failed;
        failed *= 2;
    }
    for (int n = 0; n < bisections && proved > 0; ++n) {
        const double middle = std::sqrt(proved * failed);
        (co_await shrinks(map, target, middle) ? proved : failed) = middle;
    }
    co_return proved;
}

}  // namespace

Neighbourhood::Neighbourhood(Point centre, const Eigen::Matrix2d& metric, double radius)
    : centre_(std::move(centre)), shape_(metric / (radius * radius)) {
    const double determinant = shape_(0, 0) * shape_(1, 1) - shape_(0, 1) * shape_(0, 1);
    reach_ = {std::sqrt(shape_(1, 1) / determinant), std::sqrt(shape_(0, 0) / determinant)};
}

// shape = L L^T: L^T carries the ellipse to the unit circle.
Point Neighbourhood::boundary(double angle) const {
    const Point on_circle(std::cos(angle), std::sin(angle));
    return centre_ + shape_.llt().matrixU().solve(on_circle);
}

Task<std::vector<Neighbourhood>> find_neighbourhoods(StroboscopicMap& map, Point orbit_point, std::int64_t q,
                                                     std::int64_t count) {
    std::vector<Neighbourhood> found;
    Point point = orbit_point;
    std::int64_t reached = 0;  // cycles after the orbit's point
    for (std::int64_t n = 0; n < count; ++n) {
        for (; reached < n * q / count; ++reached) {
            const CycleResult cycle = co_await map.cycle(point);
            if (!cycle.ok) co_return found;
            point = cycle.end;
        }
        const CycleResult round = co_await go_round(map, point, q);
        const double multiplier = spectral_radius(round.jacobian);
        if (!round.ok || !(multiplier < largest_multiplier)) co_return found;
        const Target target{point, q, AdaptedNorm(round.jacobian, multiplier), round.pattern};
        const double radius = co_await largest_that_shrinks(map, target);
        if (radius > 0) found.emplace_back(point, target.norm.metric(), radius / 2);
    }
    co_return found;
}

}  // namespace peterka::regime
