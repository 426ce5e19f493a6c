// The contribution of one leg of linear motion to a recorder beyond the force: a bound on the displacement or
// its true maximum, the integrals of force, power and energy, and the leg itself for an observer.
#pragma once

#include <cmath>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "trajectory/largest_value.hpp"
#include "trajectory/leg_integrals.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::trajectory {

// Bound on |u| over a leg of this duration: from the parts of its motion or, where these nearly cancel close to
// resonance, from its initial energy and the work that the drive can do. `position` is the probe of delta.
template <class Real>
Real displacement_bound(const scene::Oscillator<Real>& oscillator, const motion::Probe<Real>& position,
                        const motion::Leg<Real>& leg, Real duration) {
    const Real natural = leg.motion().natural_frequency();
    const scene::State<Real>& x = leg.start().state;
    const Real by_parts = position.swing() + position.transient(leg.start().homogeneous);
    const Real by_energy =
        std::hypot(x[0] - position.rest(), x[1] / natural) + oscillator.drive() * duration / natural;
    return std::abs(position.rest() + oscillator.gap) + (by_parts < by_energy ? by_parts : by_energy);
}

// Largest |u| of the motion between two moments.
template <class Real>
Real largest_displacement(const scene::Oscillator<Real>& oscillator, const motion::Leg<Real>& leg,
                          const motion::Moment<Real>& from, const motion::Moment<Real>& end, Real largest) {
    const motion::Signal<Real> u{.position = 1, .constant = oscillator.gap};
    largest = LargestValue<Real>(u, leg.motion()).over(leg, from, end, largest);
    return LargestValue<Real>(-u, leg.motion()).over(leg, from, end, largest);
}

// `from`: up to there the displacement changes monotonically from its value at the start.
// `force`: the signal of the stop's force, nullptr where it doesn't press.
template <class Real>
void record_contacts(const scene::Oscillator<Real>& oscillator, const motion::Leg<Real>& leg,
                     const motion::Moment<Real>& from, const motion::Moment<Real>& end,
                     const motion::Probe<Real>* force, Recorder<Real>& recorder) {
    recorder.displacement(
        largest_displacement(oscillator, leg, from, end, recorder.totals().largest_displacement));
    if (force == nullptr && !recorder.records_energy()) return;

    using Integrals = Eigen::Matrix<Real, 4, 1>;  // f, f delta', sin(theta) u', u'^2
    const Integrals integrals =
        integrate_leg(leg, end.time, Integrals(Integrals::Zero()), [&](const motion::Moment<Real>& m) {
            const Real f = force == nullptr ? Real(0) : force->value(m);
            const Real velocity = m.state[1];
            return Integrals(f, f * velocity, m.sine * velocity, velocity * velocity);
        });
    if (force != nullptr) recorder.press({integrals[0], end.time, integrals[1]});
    if (recorder.records_energy()) {
        recorder.energy(oscillator.drive() * integrals[2], 2 * oscillator.damping_ratio * integrals[3]);
    }
}

// `from`: tau of the cycle where the leg begins; it lasts for `length`.
template <class Real>
void observe_leg(Phase phase, const motion::Leg<Real>& leg, Real from, Real length, Recorder<Real>& recorder) {
    if (recorder.observer() == nullptr) return;
    recorder.observer()->stretch(phase, from, length, [&](Real t) {
        return recorder.seen(from + t, t > 0 ? leg.at(t).state : leg.start().state);
    });
}

}  // namespace peterka::trajectory
