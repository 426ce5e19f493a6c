// The part of a cell's result that describes the orbit on which its motion ends.
#pragma once

#include <cmath>
#include <cstdint>

#include "regime/cell_result.hpp"
#include "regime/lasting_motion_proof.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

// jacobian: of a whole period, in any scales. point: (delta, delta') on the orbit at forcing phase 0.
inline void write_orbit(CellResult& result, const Eigen::Matrix2d& jacobian, std::int64_t period,
                        const scene::State<double>& point, double gap) {
    result.period = static_cast<std::int32_t>(period);
    result.multiplier = spectral_radius(jacobian);
    if (result.multiplier > 0) result.lyapunov = std::log(result.multiplier) / static_cast<double>(period);
    result.orbit_displacement = point[0] + gap;
    result.orbit_velocity = point[1];
}

// The same for a motion that never touches, or never leaves, the stop.
inline void write_settled(CellResult& result, const SettledMotion& motion, Regime regime, double gap,
                          bool force_per_cycle) {
    result.regime = regime;
    write_orbit(result, motion.jacobian, 1, motion.point, gap);
    result.peak_force = motion.peak_force;
    result.largest_displacement = motion.largest_displacement;
    if (!force_per_cycle) return;
    result.peak_force_mean = result.peak_force_q95 = motion.peak_force;
    result.window_cycles = 1;
}

}  // namespace peterka::regime
