// Whether two results of cells are the same to the last bit.
#pragma once

#include <cstring>
#include <vector>

#include "regime/cell_result.hpp"

namespace peterka::testing {

// All numbers that a file may hold.
inline std::vector<double> numbers(const regime::CellResult& c) {
    return {static_cast<double>(c.regime),
            static_cast<double>(c.status),
            static_cast<double>(c.engine),
            static_cast<double>(c.impacts),
            static_cast<double>(c.period),
            static_cast<double>(c.cycles),
            c.peak_force,
            c.largest_displacement,
            c.impact_rate,
            c.multiplier,
            c.lyapunov,
            c.sensitivity,
            c.orbit_displacement,
            c.orbit_velocity,
            c.impact_speed,
            c.impulse,
            c.contact_time,
            c.contact_power,
            c.max_displacement,
            c.peak_force_mean,
            c.peak_force_q95,
            static_cast<double>(c.window_cycles),
            static_cast<double>(c.last_impact)};
}

inline bool same_bytes(const regime::CellResult& a, const regime::CellResult& b) {
    const auto x = numbers(a);
    const auto y = numbers(b);
    return std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

}  // namespace peterka::testing
