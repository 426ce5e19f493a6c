// The stroboscopic map by the classical fourth-order Runge-Kutta method with a fixed step: common practice, for
// comparison.
//
// With events, the time at which a phase ends within a step is solved for (with steps of the method itself),
// and the next step starts there: order 4. Without, every stage switches the force on by the signs of delta and
// of the force at that stage, as programs without event location do: the start and end of each contact are
// wrong by a fraction of a step, which leaves order 1.
// The Jacobian is integrated by the variational equations; without events it lacks the jumps at the switching
// surfaces (saltation matrices, Leine & Nijmeijer 2004). Spring-dashpot stops (Kelvin-Voigt) with springs of
// any cubic stiffness.
// Limits of validity: steps must be shorter than about 2.8 over the fastest rate of the contact, sqrt(kappa) or
// chi, or the solution overflows (not_finite). Hops that rise and fall within one step are missed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "trajectory/cycle.hpp"
#include "trajectory/equation_of_motion.hpp"

namespace peterka::study {

using scene::Jacobian;
using scene::Oscillator;
using scene::State;
using trajectory::Cycle;
using trajectory::MeasuredCycle;
using trajectory::Phase;
using trajectory::phase_of;

enum class Rk4Events { located, ignored };

class Rk4CycleMap {
  public:
    Rk4CycleMap(const Oscillator<double>& oscillator, int steps_per_cycle, Rk4Events events)
        : oscillator_(oscillator), steps_(steps_per_cycle), events_(events) {}

    [[nodiscard]] const Oscillator<double>& oscillator() const { return oscillator_; }

    // One cycle from the state x at forcing phase 0.
    [[nodiscard]] MeasuredCycle<double> operator()(const State<double>& x, bool measure) const;

  private:
    // (delta, delta') in the first column, the Jacobian in the others.
    using Block = Eigen::Matrix<double, 2, 3>;
    struct Sample {  // force of the present phase, and its rate
        double force = 0;
        double slope = 0;
    };

    [[nodiscard]] Block rate(Phase phase, const Block& z, double time) const;
    [[nodiscard]] Block step(Phase phase, const Block& z, double time, double h) const;
    [[nodiscard]] Phase phase_at(Phase phase, const Block& z) const {
        return events_ == Rk4Events::located ? phase : phase_of(oscillator_, State<double>(z.col(0)));
    }
    // Positive once the phase is over.
    [[nodiscard]] double over(Phase phase, const Block& z) const;
    [[nodiscard]] double event_in_step(Phase phase, const Block& z, double time, double h) const;
    [[nodiscard]] Phase enter_next(Phase phase, Block& z, double time, MeasuredCycle<double>& cycle) const;
    [[nodiscard]] Sample sample(const Block& z, double time) const;
    void measure_step(Phase phase, const Block& from, double time, const Block& to, double h,
                      MeasuredCycle<double>& cycle) const;

    Oscillator<double> oscillator_;
    int steps_;
    Rk4Events events_;
};

}  // namespace peterka::study
