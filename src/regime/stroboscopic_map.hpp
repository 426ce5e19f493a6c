// The stroboscopic map as the decision procedure sees it: scaled to states of order one, and counting its
// cycles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "regime/engine.hpp"

namespace peterka::regime {

using trajectory::append;
using trajectory::EventPattern;
using trajectory::Recorder;

using Point = Eigen::Vector2d;  // (delta, delta') over the scales of the scene

// q cycles in a row.
struct Passage {
    bool ok = true;
    trajectory::Cycle<double>::Outcome outcome = trajectory::Cycle<double>::Outcome::done;
    Point end;
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
    EventPattern pattern = 0;
    bool touched = false;
    bool separated = false;
};

class StroboscopicMap {
  public:
    // The response to the forcing off resonance sets the length, the faster of both frequencies the time.
    StroboscopicMap(const scene::Oscillator<double>& scene, const EngineSettings& settings)
        : scene_(scene), settings_(settings), cycle_(make_cycle_map(scene, settings)) {
        const double length = scene.drive() / (1 + scene.drive());
        scale_ = {length, length * std::max(1.0, scene.frequency)};
    }

    // The same engine on another scene.
    [[nodiscard]] StroboscopicMap with_scene(const scene::Oscillator<double>& scene) const {
        return {scene, settings_};
    }

    [[nodiscard]] const scene::Oscillator<double>& scene() const { return scene_; }
    [[nodiscard]] Point scaled(const scene::State<double>& x) const { return x.cwiseQuotient(scale_); }
    [[nodiscard]] scene::State<double> unscaled(const Point& x) const { return x.cwiseProduct(scale_); }
    [[nodiscard]] Eigen::Matrix2d unscaled(const Eigen::Matrix2d& jacobian) const {
        return scale_.asDiagonal() * jacobian * scale_.cwiseInverse().asDiagonal();
    }
    // Relative error of a cycle beyond rounding: results of integrators are rough on this scale.
    [[nodiscard]] double noise() const {
        const bool integrates = settings_.engine == Engine::cvode || settings_.engine == Engine::arkode;
        return integrates ? settings_.tolerance : 0;
    }
    [[nodiscard]] Engine engine() const { return settings_.engine; }
    [[nodiscard]] std::int64_t cycles_spent() const { return spent_; }

    [[nodiscard]] Passage advance(const Point& from, std::int64_t cycles,
                                  Recorder<double>* recorder = nullptr) {
        Passage passage;
        passage.end = from;
        for (std::int64_t n = 0; n < cycles && passage.ok; ++n) {
            const trajectory::Cycle<double> cycle =
                std::visit([&](auto& map) { return map(unscaled(passage.end), recorder); }, cycle_);
            ++spent_;
            passage.ok = cycle.outcome == trajectory::Cycle<double>::Outcome::done;
            passage.outcome = cycle.outcome;
            passage.end = scaled(cycle.end);
            passage.jacobian = (cycle.jacobian * passage.jacobian).eval();
            passage.pattern = append(passage.pattern, cycle.pattern);
            passage.touched |= cycle.touched;
            passage.separated |= cycle.separated;
        }
        passage.jacobian = scale_.cwiseInverse().asDiagonal() * passage.jacobian * scale_.asDiagonal();
        return passage;
    }

  private:
    scene::Oscillator<double> scene_;
    EngineSettings settings_;
    CycleMap cycle_;
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
