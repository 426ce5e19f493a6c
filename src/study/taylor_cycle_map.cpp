#include "study/taylor_cycle_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "study/taylor_motion.hpp"
#include "study/taylor_series.hpp"
#include "support/stop_request.hpp"
#include "trajectory/first_crossing.hpp"

namespace peterka::study {

namespace {

using taylor::Point;
using taylor::Real;
using taylor::samples;
using taylor::TaylorMotion;

constexpr int most_steps = 400'000;  // about a second
constexpr int most_events = 20'000;
constexpr Real step_turn = 0.5L;   // of the fastest rate: 0.5^25/25! is far below rounding
constexpr Real step_share = 0.2L;  // of the radius of convergence, where it is finite: 0.2^25 = 3e-18

// The motion with a stop that has a force law.
template <class Force>
class ForcedMotion : private TaylorMotion {
  public:
    ForcedMotion(const Oscillator<Real>& oscillator, const State<Real>& x, const Force& force)
        : TaylorMotion(oscillator, x), force_(force) {
        if (point_.position > 0) {
            phase_ = force_.pressing(point_) > 0 ? Phase::contact : Phase::unloaded;
        } else if (point_.position == 0 && point_.velocity > 0) {
            phase_ = Phase::contact;
        }
    }

    MeasuredCycle<Real> run() {
        using Outcome = typename Cycle<Real>::Outcome;
        int events = 0;
        for (int steps = 0; time_ < period_; ++steps) {
            stop_if_asked();
            if (steps == most_steps) return finished(Outcome::solver_failed);
            if (events == most_events) return finished(Outcome::too_many_events);
            cycle_.touched |= phase_ == Phase::contact;
            cycle_.separated |= phase_ == Phase::flight;
            const bool event = step();
            if (!in_range()) return finished(Outcome::not_finite);
            if (!event) continue;
            ++events;
            begin_next_phase();
        }
        return finished(Outcome::done);
    }

  private:
    // Whether the stop's force counts at this point: not at depths at which it has no effect.
    [[nodiscard]] bool force_counts() const {
        if (phase_ != Phase::contact) return false;
        return force_.is_analytic() || point_.position >= floor_;
    }

    [[nodiscard]] Real step_length() const {
        if (phase_ != Phase::contact) return step_turn / free_rate();
        const Real turn = step_turn / (free_rate() + force_.fastest_rate(point_));
        if (force_.is_analytic()) return turn;
        const Real v = std::abs(point_.velocity);
        const Real a = free_acceleration_;
        if (force_counts()) {  // a lower bound on the time to delta = 0
            return std::min(turn, step_share * trajectory::parabola_step(-point_.position, v, a));
        }
        // to a little above the floor, or through 0
        return std::min(turn, 3 * floor_ / (v + std::sqrt(v * v + 6 * a * floor_)));
    }

    bool step() {
        if (!force_.is_analytic() && phase_ == Phase::contact) {
            // a bound on the acceleration, for step lengths and depths
            free_acceleration_ = oscillator_.drive() + std::abs(point_.position + oscillator_.gap) +
                                 2 * oscillator_.damping_ratio * std::abs(point_.velocity) +
                                 force_.value(point_);
            floor_ = force_.floor(point_.velocity, std::abs(press(time_)));
        }
        const bool presses = force_counts();
        const Real longest = period_ - time_;
        Real end = std::min(longest, step_length());
        expand([&](std::size_t n) { return presses ? force_.coefficient(series_, n) : Real(0); });
        const bool event = find_event(end, [&](Real t) { return over(taylor::at(series_, t)); });
        if (presses) raise_peak(end);
        cycle_.largest_displacement = std::max(cycle_.largest_displacement,
                                               std::abs(taylor::at(series_, end).position + oscillator_.gap));
        point_ = taylor::at(series_, end);
        pass(end, longest);
        return event;
    }

    // Positive once the phase is over.
    [[nodiscard]] Real over(const Point& p) const {
        switch (phase_) {
            case Phase::flight:
                return p.position;
            case Phase::contact:
                if (force_.is_analytic()) return -force_.pressing(p);
                return std::max(-p.position, -force_.pressing(p));
            case Phase::unloaded:
                break;
        }
        return std::max(-p.position, force_.pressing(p));
    }

    void begin_next_phase() {
        if (phase_ == Phase::flight) {
            point_.position = 0;
            touch();
            phase_ = Phase::contact;
            return;
        }
        const bool leaves = !(point_.position > 0) || (phase_ == Phase::contact && is_elastic());
        if (leaves) {
            point_.position = 0;
            phase_ = Phase::flight;
        } else {
            phase_ = phase_ == Phase::contact ? Phase::unloaded : Phase::contact;
        }
    }
    // An elastic stop releases where it was touched.
    [[nodiscard]] bool is_elastic() const { return force_.is_analytic() && force_.value({0, 1}) == 0; }

    // Within a step the force has at most one maximum.
    void raise_peak(Real end) {
        const auto slope = [&](Real t) {
            return force_.slope(taylor::at(series_, t), taylor::acceleration_at(series_, t));
        };
        const auto raise = [&](Real t) {
            cycle_.peak_force = std::max(cycle_.peak_force, force_.value(taylor::at(series_, t)));
        };
        raise(0);
        raise(end);
        Real rising = 0;
        Real falling = end;
        if (!(slope(rising) > 0 && slope(falling) < 0)) return;
        for (int halving = 0; halving < 64; ++halving) {
            const Real middle = (rising + falling) / 2;
            (slope(middle) > 0 ? rising : falling) = middle;
        }
        raise(rising);
    }

    Force force_;
    Phase phase_ = Phase::flight;
    Real floor_ = 0;
    Real free_acceleration_ = 0;
};

// The motion with a rigid stop.
class RigidMotion : private TaylorMotion {
  public:
    RigidMotion(const Oscillator<Real>& oscillator, const State<Real>& x, Real restitution)
        : TaylorMotion(oscillator, x), restitution_(restitution) {
        if (point_.position == 0 && point_.velocity > 0) {
            strike();
        } else if (point_.position == 0 && point_.velocity == 0) {
            sticks_ = press(0) > 0;
        }
    }

    MeasuredCycle<Real> run() {
        using Outcome = typename Cycle<Real>::Outcome;
        if (point_.position > 0) return finished(Outcome::not_finite);  // no state lies beyond a rigid stop
        int events = 0;
        for (int steps = 0; time_ < period_; ++steps) {
            stop_if_asked();
            if (steps == most_steps) return finished(Outcome::solver_failed);
            if (events == most_events) return finished(Outcome::too_many_events);
            cycle_.touched |= sticks_;
            cycle_.separated |= !sticks_;
            events += (sticks_ ? stick() : fly()) ? 1 : 0;
            if (!in_range()) return finished(Outcome::not_finite);
        }
        if (struck_) cycle_.peak_force = std::numeric_limits<Real>::quiet_NaN();
        return finished(Outcome::done);
    }

  private:
    bool fly() {
        const Real longest = period_ - time_;
        Real end = std::min(longest, step_turn / free_rate());
        // a hop right after an impact must not be missed between samples
        const Real a = press(time_);
        if (point_.position == 0 && a > 0) end = std::min(end, 4 * std::abs(point_.velocity) / a);
        expand([](std::size_t) { return Real(0); });
        const bool event = find_event(end, [&](Real t) { return taylor::at(series_, t).position; });
        cycle_.largest_displacement = std::max(cycle_.largest_displacement,
                                               std::abs(taylor::at(series_, end).position + oscillator_.gap));
        for (int n = 0; n <= samples; ++n) {
            if (!(press(time_ + end * Real(n) / samples) > 0)) impacts_while_pressed_ = 0;
        }
        point_ = taylor::at(series_, end);
        pass(end, longest);
        if (event) strike();
        return event;
    }

    void strike() {
        point_.position = 0;
        if (!(point_.velocity > 0)) {  // grazing
            point_.velocity = 0;
            sticks_ = press(time_) > 0;
            return;
        }
        touch();
        struck_ = true;
        point_.velocity *= -restitution_;
        const Real a = press(time_);
        if (!(a > 0)) {
            impacts_while_pressed_ = 0;
            return;
        }
        ++impacts_while_pressed_;
        // time of all impacts still to come: the chatter is complete once this is below the resolution
        const Real rest = restitution_ < 1 ? -2 * point_.velocity / (a * (1 - restitution_)) : period_;
        if (rest > std::numeric_limits<Real>::epsilon() * period_) return;
        point_.velocity = 0;
        cycle_.impacts -= impacts_while_pressed_ - 1;
        impacts_while_pressed_ = 0;
        sticks_ = true;
    }

    bool stick() {
        const Real longest = period_ - time_;
        Real end = std::min(longest, step_turn / free_rate());
        const bool event = find_event(end, [&](Real t) { return -press(time_ + t); });
        raise_peak(end);
        pass(end, longest);
        sticks_ = !event;
        return event;
    }

    // The largest force of a step at rest: next to the largest sample, by ternary search.
    void raise_peak(Real end) {
        int largest = 0;
        for (int n = 1; n <= samples; ++n) {
            if (press(sample_time(n, end)) > press(sample_time(largest, end))) largest = n;
        }
        Real from = sample_time(std::max(largest - 1, 0), end);
        Real to = sample_time(std::min(largest + 1, samples), end);
        for (int n = 0; n < 120; ++n) {
            const Real third = (to - from) / 3;
            const bool rises = press(from + third) < press(to - third);
            (rises ? from : to) = rises ? from + third : to - third;
        }
        cycle_.peak_force = std::max({cycle_.peak_force, press(from), press(to)});
    }
    [[nodiscard]] Real sample_time(int n, Real length) const { return time_ + length * Real(n) / samples; }

    Real restitution_;
    bool sticks_ = false;
    bool struck_ = false;
    int impacts_while_pressed_ = 0;
};

}  // namespace

MeasuredCycle<TaylorCycleMap::Real> TaylorCycleMap::operator()(const State<Real>& x) const {
    return std::visit(
        [&]<class Law>(const Law& law) -> MeasuredCycle<Real> {
            if constexpr (Law::Given::is_rigid) {
                return RigidMotion(oscillator_, x, law.coefficient).run();
            } else if constexpr (std::is_same_v<Law, scene::KelvinVoigt<Real>>) {
                return ForcedMotion(oscillator_, x, taylor::KelvinVoigtForce(law)).run();
            } else if constexpr (std::is_same_v<Law, scene::HuntCrossley<Real>>) {
                return ForcedMotion(oscillator_, x, taylor::HuntCrossleyForce(law)).run();
            } else {  // a force without a series here
                MeasuredCycle<Real> none;
                none.outcome = Cycle<Real>::Outcome::solver_failed;
                return none;
            }
        },
        oscillator_.contact);
}

}  // namespace peterka::study
