#include "curves/turn_back.hpp"

#include "curves/reshape.hpp"

namespace peterka::curves {

std::optional<OrbitPoint> last_before_turn(const Stepper& stepper, const Stepper::Here& here,
                                           const OrbitPoint& there,
                                           const std::function<double(const Eigen::VectorXd&)>& function) {
    constexpr int most_halvings = 40;
    const bool sign = function(here.tangent) > 0;
    OrbitPoint low = here.point;
    OrbitPoint high = there;
    for (int halving = 0; halving < most_halvings; ++halving) {
        const auto middle =
            solve(stepper.rig(), between(low, high, 0.5), stepper.window(), stepper.conditions());
        if (!middle) return std::nullopt;
        const bool before = (function(stepper.at(*middle, here.tangent).tangent) > 0) == sign;
        (before ? low : high) = *middle;
    }
    return low;
}

}  // namespace peterka::curves
