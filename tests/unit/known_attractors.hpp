// What a start ends on, and what it ends on where attractors are known before.
#pragma once

#include <tuple>
#include <vector>

#include "regime/attractor_table.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"

namespace peterka::testing {

inline std::vector<regime::FoundAttractor> found_from(const scene::Oscillator<double>& oscillator,
                                                      double displacement, double velocity,
                                                      const regime::EngineSettings& settings = {}) {
    std::vector<regime::FoundAttractor> found;
    regime::CycleBroker broker;
    std::ignore = regime::complete(
        regime::find_steady_state(broker, oscillator, start_at(oscillator, displacement, velocity), {},
                                  settings, regime::Measures{}, {nullptr, &found}),
        broker);
    return found;
}

inline regime::CellResult solve_knowing(const regime::AttractorTable& known,
                                        const scene::Oscillator<double>& oscillator, double displacement,
                                        double velocity) {
    regime::CycleBroker broker;
    return regime::complete(
        regime::find_steady_state(broker, oscillator, start_at(oscillator, displacement, velocity), {}, {},
                                  regime::Measures{}, {&known, nullptr}),
        broker);
}

}  // namespace peterka::testing
