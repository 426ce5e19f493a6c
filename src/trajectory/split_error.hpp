// The error of a split cycle map, estimated by halving its step.
//
// At second order the error with step h/2 is a quarter of that with h, so their difference is 3/4 of the
// latter.
#pragma once

#include <cmath>

#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {

template <class Real>
struct SplitError {
    State<Real> end = State<Real>::Zero();  // of the state after the cycles, (delta, delta')
    Real peak_force = 0;                    // relative, of the largest force during them
    bool comparable = false;                // both step lengths gave the same contacts, and no failure
};

// Runs `cycles` forcing cycles from the state x at phase 0 with the map and with half its step, each after
// `settling` cycles of its own: none for the error of the cycles themselves, enough for the transient to decay
// for the error of a stable orbit.
template <class Real, class Legs>
SplitError<Real> split_error(const SplitCycleMap<Real, Legs>& map, const State<Real>& x, int cycles,
                             int settling = 0) {
    const SplitCycleMap<Real, Legs> fine(map.oscillator(), 2 * map.steps_per_cycle());
    State<Real> state[2] = {x, x};
    Recorder<Real> recorder[2];
    SplitError<Real> error{.comparable = true};
    for (int n = 0; n < settling + cycles && error.comparable; ++n) {
        const bool counts = n >= settling;
        const Cycle<Real> coarse_cycle = map(state[0], counts ? &recorder[0] : nullptr);
        const Cycle<Real> fine_cycle = fine(state[1], counts ? &recorder[1] : nullptr);
        state[0] = coarse_cycle.end;
        state[1] = fine_cycle.end;
        using Outcome = typename Cycle<Real>::Outcome;
        error.comparable = coarse_cycle.outcome == Outcome::done && fine_cycle.outcome == Outcome::done &&
                           (!counts || coarse_cycle.pattern == fine_cycle.pattern);
    }
    error.end = Real(4) / 3 * (state[0] - state[1]).cwiseAbs();
    const Real force = recorder[1].totals().peak_force();
    if (force > 0) {
        error.peak_force = Real(4) / 3 * std::abs(recorder[0].totals().peak_force() / force - 1);
    }
    return error;
}

}  // namespace peterka::trajectory
