// The oscillator and engine that carry the motion of a solved cell from cycle to cycle.
#pragma once

#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"

namespace peterka::trace {

struct Carrier {
    scene::Oscillator<double> oscillator;  // as solved: with its cubic spring or without
    regime::EngineSettings settings;
};

// The engine used last is that of the result, or one that only examined the effect of the cubic spring.
inline Carrier carrier_of(const regime::CycleBroker& broker, const regime::CellResult& result) {
    Carrier carrier{broker.oscillator(), broker.settings()};
    if (result.engine == regime::Engine::exact) {
        carrier.oscillator = without_cubic(carrier.oscillator);
        carrier.settings = {};
    }
    return carrier;
}

}  // namespace peterka::trace
