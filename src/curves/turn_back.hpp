// Where a curve turns back: at a cusp, or in the direction of one axis.
#pragma once

#include <functional>
#include <optional>

#include "curves/branch_step.hpp"

namespace peterka::curves {

// Of a step between points with the same events, the last point before a function of the tangent changes its
// sign, by bisection; none where Newton's method fails.
[[nodiscard]] std::optional<OrbitPoint> last_before_turn(
    const Stepper& stepper, const Stepper::Here& here, const OrbitPoint& there,
    const std::function<double(const Eigen::VectorXd&)>& function);

}  // namespace peterka::curves
