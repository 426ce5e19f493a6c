// Where an orbit of period 1 has a given Floquet multiplier: Newton's method on (the orbit closes, the
// multiplier is exactly so), derivatives by differences.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/oscillator.hpp"

namespace peterka::testing {

// The parameter at which it is so. map_of(parameter) is a cycle map; near: an orbit and a parameter close by;
// longest_step keeps to the branch of that orbit.
template <class MapOf>
double critical_parameter(const MapOf& map_of, double multiplier, const scene::State<double>& orbit,
                          double near, double longest_step = std::numeric_limits<double>::infinity()) {
    Eigen::Vector3d y(orbit[0], orbit[1], near);
    const auto residual = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        const auto cycle = map_of(at[2])(scene::State<double>(at[0], at[1]));
        const auto& j = cycle.jacobian;
        return {cycle.end[0] - at[0], cycle.end[1] - at[1],
                multiplier * multiplier - multiplier * j.trace() + j.determinant()};
    };
    for (int step = 0; step < 30; ++step) {
        Eigen::Matrix3d slope;
        for (int i = 0; i < 3; ++i) {
            Eigen::Vector3d shift = Eigen::Vector3d::Zero();
            shift[i] = 1e-6;
            slope.col(i) = (residual(y + shift) - residual(y - shift)) / 2e-6;
        }
        const Eigen::Vector3d correction = slope.partialPivLu().solve(-residual(y));
        y += correction * std::min(1.0, longest_step / correction.norm());
        if (correction.norm() < 1e-13) break;
    }
    return y[2];
}

}  // namespace peterka::testing
