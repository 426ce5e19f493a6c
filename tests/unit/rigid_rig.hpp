// A hammer that hits a rigid stop.
#pragma once

#include "scene/oscillator.hpp"

namespace peterka::testing {

template <class Real = double>
scene::Oscillator<Real> rigid(double restitution, double frequency, double gap, double zeta = 0.02) {
    return {.damping_ratio = static_cast<Real>(zeta),
            .contact = scene::Restitution<Real>{static_cast<Real>(restitution)},
            .frequency = static_cast<Real>(frequency),
            .gap = static_cast<Real>(gap)};
}

}  // namespace peterka::testing
