// One step along a one-dimensional family of orbits: a guess along the tangent, then Newton's shortest way back
// (pseudo-arclength continuation).
#pragma once

#include <optional>
#include <vector>

#include "curves/defining_system.hpp"

namespace peterka::curves {

class Stepper {
  public:
    Stepper(const Rig& rig, const PlanePoint& window, std::vector<Condition> conditions)
        : rig_(&rig), window_(window), conditions_(std::move(conditions)) {}

    [[nodiscard]] const Rig& rig() const { return *rig_; }
    [[nodiscard]] const PlanePoint& window() const { return window_; }
    [[nodiscard]] const std::vector<Condition>& conditions() const { return conditions_; }
    // The conditions and one more.
    [[nodiscard]] std::vector<Condition> conditions_and(const Condition& condition) const;

    struct Here {
        OrbitPoint point;
        Eigen::VectorXd tangent;  // in sizes of the unknowns
    };
    // The tangent at a point, so that it points along `ahead`, or, without it, as it comes.
    [[nodiscard]] Here at(const OrbitPoint& point, const Eigen::VectorXd& ahead = {}) const;
    // The next point; a step that bends too much or fails is halved, one that bends little makes the next one
    // longer. None where steps become too short.
    [[nodiscard]] std::optional<Here> next(const Here& here, double longest);

    void set_step(double step) { step_ = step; }
    [[nodiscard]] double step() const { return step_; }
    // What the place moves along a tangent, in shares of the window.
    [[nodiscard]] static PlanePoint along(const Eigen::VectorXd& tangent) {
        return {tangent[tangent.size() - 2], tangent[tangent.size() - 1]};
    }

  private:
    const Rig* rig_;
    PlanePoint window_;  // its sizes
    std::vector<Condition> conditions_;
    double step_ = 1e-3;
};

}  // namespace peterka::curves
