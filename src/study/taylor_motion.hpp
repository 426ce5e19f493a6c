// The part of a motion by power series that is independent of the stop's law: the forces on the hammer except
// the stop's, and the clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/taylor_series.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::study::taylor {

using scene::Oscillator;
using scene::State;
using trajectory::Cycle;
using trajectory::Phase;

inline constexpr int samples = 16;          // per step, to bracket the end of a phase
inline constexpr Real out_of_range = 1e9L;  // a softening spring that has given way never completes its cycle

class TaylorMotion {
  public:
    TaylorMotion(const Oscillator<Real>& oscillator, const State<Real>& x)
        : oscillator_(oscillator),
          cart_(oscillator.cubic_form == job::CubicForm::absolute ? 1 : 0),
          period_(oscillator.period()),
          point_{x[0], x[1]} {
        cycle_.jacobian.setConstant(std::numeric_limits<Real>::quiet_NaN());
    }

  protected:
    // Coefficients of delta(time + t) with delta'' = eta^2 sin - u - 2 zeta u' - cubic ((u + y)^3 - y^3) - f.
    template <class Force>
    void expand(Force force) {
        Series y{};        // the cart
        Series x{};        // the argument of the spring's cubic term
        Series squares{};  // x^2 and y^2
        Series cart_squares{};
        const Real angle = oscillator_.frequency * time_;
        Real wave[2] = {std::sin(angle), std::cos(angle)};
        series_[0] = point_.position;
        series_[1] = point_.velocity;
        for (std::size_t n = 0; n + 2 <= order; ++n) {
            y[n] = n % 4 < 2 ? wave[n % 2] : -wave[n % 2];
            const Real u = series_[n] + (n == 0 ? oscillator_.gap : 0);
            Real acceleration = oscillator_.drive() * y[n] - u -
                                2 * oscillator_.damping_ratio * Real(n + 1) * series_[n + 1] - force(n);
            if (oscillator_.cubic != 0) {
                x[n] = u + cart_ * y[n];
                Real cube = 0;
                for (std::size_t a = 0; a <= n; ++a) {
                    squares[n] += x[a] * x[n - a];
                    cart_squares[n] += y[a] * y[n - a];
                }
                for (std::size_t a = 0; a <= n; ++a) {
                    cube += squares[a] * x[n - a] - cart_ * cart_squares[a] * y[n - a];
                }
                acceleration -= oscillator_.cubic * cube;
            }
            series_[n + 2] = acceleration / Real((n + 1) * (n + 2));
            wave[0] *= oscillator_.frequency / Real(n + 1);
            wave[1] *= oscillator_.frequency / Real(n + 1);
        }
    }

    [[nodiscard]] Real free_rate() const {
        const Real reach = std::abs(point_.position + oscillator_.gap) + cart_;
        return 1 + oscillator_.frequency + 2 * oscillator_.damping_ratio +
               std::sqrt(6 * std::abs(oscillator_.cubic)) * reach;
    }

    // The net force that presses a hammer at rest against the stop.
    [[nodiscard]] Real press(Real time) const {
        const Real sine = std::sin(oscillator_.frequency * time);
        const Real y = cart_ * sine;
        const Real x = oscillator_.gap + y;
        return oscillator_.drive() * sine - oscillator_.gap - oscillator_.cubic * (x * x * x - y * y * y);
    }

    // The first time within the step at which `over` is positive, or the step's end. The step's beginning is
    // excluded, as it may lie on the surface of the previous event.
    template <class Over>
    [[nodiscard]] bool find_event(Real& end, Over over) const {
        const Real length = end;
        for (int n = 1; n <= samples; ++n) {
            const Real t = length * Real(n) / samples;
            if (!(over(t) > 0)) continue;
            Real before = length * Real(n - 1) / samples;
            end = t;
            for (int halving = 0; halving < 80; ++halving) {
                const Real middle = (before + end) / 2;
                if (middle == before || middle == end) break;
                (over(middle) > 0 ? end : before) = middle;
            }
            return true;
        }
        return false;
    }

    void pass(Real duration, Real longest) { time_ = duration == longest ? period_ : time_ + duration; }
    [[nodiscard]] bool in_range() const {
        return std::abs(point_.position) < out_of_range && std::abs(point_.velocity) < out_of_range;
    }

    void touch() {
        ++cycle_.impacts;
        cycle_.last_touch = time_;
        cycle_.impact_speed = std::max(cycle_.impact_speed, point_.velocity);
    }

    MeasuredCycle<Real> finished(typename Cycle<Real>::Outcome outcome) {
        cycle_.outcome = outcome;
        cycle_.end = {point_.position, point_.velocity};
        return cycle_;
    }

    Oscillator<Real> oscillator_;
    Real cart_;
    Real period_;
    Real time_ = 0;  // since the cycle began
    Point point_;
    Series series_{};
    MeasuredCycle<Real> cycle_;
};

}  // namespace peterka::study::taylor
