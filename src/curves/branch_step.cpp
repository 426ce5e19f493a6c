#include "curves/branch_step.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::curves {

std::vector<Condition> Stepper::conditions_and(const Condition& condition) const {
    std::vector<Condition> all = conditions_;
    all.push_back(condition);
    return all;
}

Stepper::Here Stepper::at(const OrbitPoint& point, const Eigen::VectorXd& ahead) const {
    Here here{point, tangent(*rig_, point, window_, conditions_)};
    if (ahead.size() == here.tangent.size() && here.tangent.dot(ahead) < 0) here.tangent = -here.tangent;
    return here;
}

std::optional<Stepper::Here> Stepper::next(const Here& here, double longest) {
    constexpr double shortest = 1e-8;
    constexpr double most_bend = 0.25;  // [rad]
    for (step_ = std::min(step_, longest); step_ > shortest; step_ /= 2) {
        const Eigen::VectorXd sizes = sizes_of_unknowns(*rig_, here.point, window_);
        OrbitPoint guess = here.point;
        move(guess, step_ * here.tangent.cwiseProduct(sizes));
        const auto found = solve(*rig_, guess, window_, conditions_);
        if (!found) continue;
        const Here there = at(*found, here.tangent);
        const double bend = std::acos(std::clamp(there.tangent.dot(here.tangent), -1.0, 1.0));
        if (bend > most_bend && step_ > 16 * shortest) continue;
        if (bend < most_bend / 3) step_ *= 1.7;
        return there;
    }
    return std::nullopt;
}

}  // namespace peterka::curves
