// The stroboscopic map of the hammer by the general-purpose integrators of SUNDIALS, CVODE and ARKODE.
//
// The same map as trajectory/exact_cycle_map.hpp (which describes legs and phases), for every contact law and
// springs of any cubic stiffness in either form. The Jacobian is integrated with the state, by the variational
// equations. Each leg is integrated in its own time, from 0; an event is located to the integrator's accuracy
// and the next leg restarts exactly on the event's surface. How events are found: integrators/search.hpp.
// Impacts on a rigid stop: trajectory/rigid_course.hpp.
//
// Limits of validity, as measured on eight cells of the paper's 170 mm rig and on random scenes:
//   - The relative error of a periodic orbit's peak force stays at or below the requested tolerance, from 1e-4
//     to 1e-9; at 1e-9 it is 1e-9 (cvode_adams, cvode_bdf), 6e-11 (arkode_explicit), 5e-10 (arkode_implicit).
//   - Stops up to kappa = 1e12 and zeta_i = 100 need the implicit methods; there the error of arkode_implicit
//     reaches 4 tolerances. An explicit method must resolve the contact's fast decay: cvode_adams was seen to
//     run out of steps in an overdamped contact that lasts the whole cycle, at chi = 3000.
//   - The same for Hunt-Crossley stops with n from 1, K to 1e12 and D to 1e3, where D (v0 + v1) >> 1 again
//     needs the implicit methods. Its restitution tends to 1 at low speed: with n = 1, K = 1e12, D = 1e3 a
//     pressed hammer hops thousands of times and rings for a million radians, which exceeds a cycle's steps.
//   - In a contact that rings at the rate w, errors of the Jacobian are w times those of the flow. Local errors
//     are kept below 0.01/w for that; where w is above 1e12, a cycle with contacts fails (solver_failed).
//   - Forces of overdamped Hunt-Crossley contacts (D (v0 + v1) of 100 and more) and of orbits on whose way
//     errors grow were off by up to 60 tolerances. So an orbit is measured again with a hundredth of the
//     tolerance, down to 1e-12 (regime/steady_state.cpp), which left none of these off by more than one.
//   - A cycle has at most 200,000 steps (more: solver_failed), and 5,000 legs or 10,000 impacts on a rigid
//     stop (more: too_many_events).
#pragma once

#include <memory>

#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::integrators {

using scene::Oscillator;
using scene::State;
using trajectory::Cycle;
using trajectory::Recorder;

enum class Integrator { cvode_adams, cvode_bdf, arkode_explicit, arkode_implicit };

class IntegratedCycleMap {
  public:
    // relative_tolerance: requested relative error of the peak force, from 1e-12 to 0.1. Throws
    // peterka::Failure for any other value and if SUNDIALS can't be set up.
    IntegratedCycleMap(const Oscillator<double>& oscillator, Integrator integrator, double relative_tolerance);
    IntegratedCycleMap(IntegratedCycleMap&&) noexcept;
    IntegratedCycleMap& operator=(IntegratedCycleMap&&) noexcept;
    ~IntegratedCycleMap();

    [[nodiscard]] const Oscillator<double>& oscillator() const;

    // One cycle from the state x at forcing phase 0; a recorder collects what happens on the way. A failed
    // integration is an outcome of the cycle.
    Cycle<double> operator()(const State<double>& x, Recorder<double>* recorder = nullptr);
    // A part of a cycle: from the state x at tau = from to tau = to, with to > from.
    Cycle<double> part(const State<double>& x, double from, double to);

  private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace peterka::integrators
