// The stroboscopic map as the decision procedure sees it: scaled to states of order one, and counting its
// cycles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "trajectory/exact_cycle_map.hpp"

namespace peterka::regime {

using trajectory::append;
using trajectory::EventPattern;

using Point = Eigen::Vector2d;  // (delta, delta') over the scales of the scene

// q cycles in a row.
struct Passage {
    bool ok = true;
    trajectory::Cycle<double>::Outcome outcome = trajectory::Cycle<double>::Outcome::done;
    Point end;
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
    EventPattern pattern = 0;
    std::int32_t impacts = 0;
    bool touched = false;
    bool separated = false;
    double peak_force = 0;
};

class StroboscopicMap {
  public:
    // The response to the forcing off resonance sets the length, the faster of both frequencies the time.
    explicit StroboscopicMap(const scene::Oscillator<double>& scene) : cycle_(scene) {
        const double length = scene.drive() / (1 + scene.drive());
        scale_ = {length, length * std::max(1.0, scene.frequency)};
    }

    [[nodiscard]] const trajectory::ExactCycleMap<double>& cycle() const { return cycle_; }
    [[nodiscard]] Point scaled(const scene::State<double>& x) const { return x.cwiseQuotient(scale_); }
    [[nodiscard]] scene::State<double> unscaled(const Point& x) const { return x.cwiseProduct(scale_); }
    [[nodiscard]] std::int64_t cycles_spent() const { return spent_; }

    [[nodiscard]] Passage advance(const Point& from, std::int64_t cycles, bool measure_force = false) {
        Passage passage;
        passage.end = from;
        for (std::int64_t n = 0; n < cycles && passage.ok; ++n) {
            const auto cycle = cycle_(unscaled(passage.end), measure_force);
            ++spent_;
            passage.ok = cycle.outcome == trajectory::Cycle<double>::Outcome::done;
            passage.outcome = cycle.outcome;
            passage.end = scaled(cycle.end);
            passage.jacobian = (cycle.jacobian * passage.jacobian).eval();
            passage.pattern = trajectory::append(passage.pattern, cycle.pattern);
            passage.impacts += cycle.impacts;
            passage.touched |= cycle.touched;
            passage.separated |= cycle.separated;
            passage.peak_force = std::max(passage.peak_force, cycle.peak_force);
        }
        passage.jacobian = scale_.cwiseInverse().asDiagonal() * passage.jacobian * scale_.asDiagonal();
        return passage;
    }

  private:
    trajectory::ExactCycleMap<double> cycle_;
    Point scale_;
    std::int64_t spent_ = 0;
};

// Size of a point against which its errors are relative.
inline double magnitude(const Point& x) {
    return 1 + x.lpNorm<Eigen::Infinity>();
}

// Largest |eigenvalue|.
inline double spectral_radius(const Eigen::Matrix2d& matrix) {
    const double half_trace = (matrix(0, 0) + matrix(1, 1)) / 2;
    const double determinant = matrix(0, 0) * matrix(1, 1) - matrix(0, 1) * matrix(1, 0);
    const double discriminant = half_trace * half_trace - determinant;
    return discriminant < 0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(discriminant);
}

}  // namespace peterka::regime
