// One forcing cycle by CVODE: an independent way to the same numbers, for tests.
//
// Integrates the three phases of the hammer with root finding on their ends and restarts at each of them.
#pragma once

#include "scene/oscillator.hpp"

namespace peterka::testing {

struct IntegratedCycle {
    scene::State<double> end;
    int impacts = 0;
};

// start: (delta, delta') at forcing phase 0. Throws std::runtime_error where CVODE gives up.
IntegratedCycle integrate_cycle(const scene::Oscillator<double>& scene, const scene::State<double>& start);

}  // namespace peterka::testing
