// Flight through the stretches of a cycle between changes of the velocity, with what no state changes computed
// once: most of a disturbed cycle is such flight.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "motion/linear_motion.hpp"
#include "scene/oscillator.hpp"

namespace peterka::noise {

// The ends of the stretches of a cycle with so many changes, which all carts share: the first and the last are
// half as long as the others.
struct Stretches {
    std::vector<double> ends;  // parts of the cycle, from 0 to 1
    std::vector<double> sine;  // of the forcing's phase there
    std::vector<double> cosine;

    explicit Stretches(int changes) {
        for (int n = 0; n <= changes + 1; ++n) {
            ends.push_back(std::clamp((n - 0.5) / changes, 0.0, 1.0));
            sine.push_back(std::sin(2 * std::numbers::pi * ends.back()));
            cosine.push_back(std::cos(2 * std::numbers::pi * ends.back()));
        }
    }
};

class FlightSteps {
  public:
    // Whether its numbers are those of the closed form to the last few digits.
    [[nodiscard]] static bool suits(const motion::LinearMotion<double>& flight) {
        return flight.oscillates() && !flight.near_critical() && !flight.resonant();
    }
    FlightSteps(const motion::LinearMotion<double>& flight, double period, const Stretches& stretches)
        : damping_(flight.equation().damping),
          inverse_rate_(1 / flight.rate()),
          own_(std::pow(flight.natural_frequency(), 4)),
          forced_(std::abs(flight.response()) * std::pow(flight.equation().frequency, 4)),
          first_(flight, period * stretches.ends[1]),
          other_(flight, period * (stretches.ends[2] - stretches.ends[1])) {
        steady_.reserve(stretches.ends.size());
        for (std::size_t n = 0; n < stretches.ends.size(); ++n) {
            steady_.push_back(flight.steady(stretches.sine[n], stretches.cosine[n]));
            steady_.back()[0] += flight.rest();
        }
    }

    // The state at the end of a stretch; nothing where the hammer isn't proved to stay off the stop: its
    // position is that of the cubic with the same ends and velocities (Hermite), which lies below the highest
    // of its four control points (Bezier), within h^4/384 times the largest fourth derivative.
    [[nodiscard]] std::optional<scene::State<double>> end_of(std::size_t stretch,
                                                             const scene::State<double>& start) const {
        const Step& step = stretch == 0 || stretch + 2 == steady_.size() ? first_ : other_;
        const scene::State<double> decaying = start - steady_[stretch];
        const scene::State<double> end = steady_[stretch + 1] + step.flow * decaying;
        const double amplitude =
            std::abs(decaying[0]) + std::abs(damping_ * decaying[0] + decaying[1]) * inverse_rate_;
        const double h = step.length;
        const double fourth_derivative = forced_ + own_ * amplitude;
        const double highest =
            std::max({start[0], start[0] + h / 3 * start[1], end[0] - h / 3 * end[1], end[0]});
        if (!(highest + step.to_fourth / 384 * fourth_derivative < 0)) return std::nullopt;
        return end;
    }

  private:
    struct Step {
        double length;  // in tau
        double to_fourth;
        scene::Jacobian<double> flow;
        Step(const motion::LinearMotion<double>& flight, double tau)
            : length(tau), to_fourth(std::pow(tau, 4)), flow(flight.flow(tau)) {}
    };
    double damping_;
    double inverse_rate_;
    double own_;     // fourth derivative of the decaying part over its amplitude
    double forced_;  // fourth derivative of the steady part, at most
    Step first_;     // and last
    Step other_;
    std::vector<scene::State<double>> steady_;  // at the ends of the stretches
};

}  // namespace peterka::noise
