// The stroboscopic map as the decision procedure sees it: scaled to states of order one, and counting its
// cycles, which the broker's engine integrates. Scales are powers of two, so that scaling causes no rounding.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <coroutine>
#include <cstdint>
#include <span>
#include <vector>

#include "regime/cycle_broker.hpp"
#include "support/reused_memory.hpp"
#include "trajectory/contact_rates.hpp"
#include "trajectory/multiplier.hpp"

namespace peterka::regime {

using trajectory::append;
using trajectory::EventPattern;
using trajectory::Recorder;

using Point = Eigen::Vector2d;  // (delta, delta') over the scales of the scene
using Points = std::vector<Point, ReusingAllocator<Point>>;

// One cycle.
struct CycleResult {
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
    struct Several : CycleBroker::Served {
        StroboscopicMap* map;
        [[nodiscard]] std::span<const trajectory::Cycle<double>> await_resume() const {
            const auto cycles = Served::await_resume();
            map->spent_ += static_cast<std::int64_t>(cycles.size());
            return cycles;
        }
    };

    // The off-resonance response to the forcing sets the length scale, the faster of both frequencies the time
    // scale.
    StroboscopicMap(const scene::Oscillator<double>& oscillator, const EngineSettings& settings,
                    CycleBroker& broker)
        : broker_(&broker), oscillator_(oscillator), settings_(settings) {
        const double length = trajectory::response_length(oscillator);
        scale_ = {power_of_two(length), power_of_two(length * std::max(1.0, oscillator.frequency))};
        per_scale_ = scale_.cwiseInverse();
        broker.use(oscillator, settings);
    }

    [[nodiscard]] const scene::Oscillator<double>& oscillator() const { return oscillator_; }
    [[nodiscard]] const EngineSettings& settings() const { return settings_; }
    [[nodiscard]] Point scaled(const scene::State<double>& x) const { return x.cwiseProduct(per_scale_); }
    [[nodiscard]] scene::State<double> unscaled(const Point& x) const { return x.cwiseProduct(scale_); }
    [[nodiscard]] std::vector<scene::State<double>> unscaled(const Points& points) const {
        std::vector<scene::State<double>> states;
        for (const Point& point : points) states.push_back(unscaled(point));
        return states;
    }
    [[nodiscard]] Eigen::Matrix2d scaled(const Eigen::Matrix2d& jacobian) const {
        return per_scale_.asDiagonal() * jacobian * scale_.asDiagonal();
    }
    [[nodiscard]] Eigen::Matrix2d unscaled(const Eigen::Matrix2d& jacobian) const {
        return scale_.asDiagonal() * jacobian * per_scale_.asDiagonal();
    }
    // Relative error of a cycle beyond rounding: results of integrators are rough on this scale.
    [[nodiscard]] double noise() const {
        const bool integrates = settings_.engine == Engine::cvode || settings_.engine == Engine::arkode;
        return integrates ? settings_.tolerance : 0;
    }
    [[nodiscard]] Engine engine() const { return settings_.engine; }
    // From now on with another tolerance.
    void set_tolerance(double tolerance) {
        if (tolerance == settings_.tolerance) return;
        settings_.tolerance = tolerance;
        broker_->use(oscillator_, settings_);
    }
    [[nodiscard]] std::int64_t cycles_spent() const { return spent_; }

    // co_await map.cycle(from) gives the CycleResult of one cycle.
    [[nodiscard]] auto cycle(const Point& from, Recorder<double>* recorder = nullptr) {
        struct Single : Several {
            [[nodiscard]] CycleResult await_resume() const {
                return map->result_of(Several::await_resume().front());
            }
        };
        return Single{cycles(from, recorder, 1)};
    }
    // co_await map.cycles(from, recorder, count) gives consecutive cycles, valid until the next order;
    // result_of() converts each.
    [[nodiscard]] Several cycles(const Point& from, Recorder<double>* recorder, std::size_t count) {
        return Several{broker_->cycles({unscaled(from), recorder, count}), this};
    }
    [[nodiscard]] CycleResult result_of(const trajectory::Cycle<double>& cycle) const {
        return {cycle.outcome == trajectory::Cycle<double>::Outcome::done,
                cycle.outcome,
                scaled(cycle.end),
                scaled(cycle.jacobian),
                cycle.pattern,
                cycle.touched,
                cycle.separated};
    }

  private:
    static double power_of_two(double size) { return std::exp2(std::round(std::log2(size))); }

    CycleBroker* broker_;
    scene::Oscillator<double> oscillator_;
    EngineSettings settings_;
    Point scale_;
    Point per_scale_;
    std::int64_t spent_ = 0;
};

// Size of a point against which its errors are relative.
inline double magnitude(const Point& x) {
    return 1 + x.lpNorm<Eigen::Infinity>();
}

// Largest |eigenvalue|.
inline double spectral_radius(const Eigen::Matrix2d& matrix) {
    const double determinant = matrix(0, 0) * matrix(1, 1) - matrix(0, 1) * matrix(1, 0);
    return std::abs(trajectory::largest_multiplier((matrix(0, 0) + matrix(1, 1)) / 2, determinant));
}

}  // namespace peterka::regime
