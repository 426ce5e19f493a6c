// One step along a one-parameter family of orbits: tangent predictor, then minimum-norm Newton corrections
// (Allgower & Georg 1990, ch. 3; a variant of the pseudo-arclength continuation of Keller 1977).
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
    // The conditions plus `condition`.
    [[nodiscard]] std::vector<Condition> conditions_and(const Condition& condition) const;

    struct Here {
        OrbitPoint point;
        Eigen::VectorXd tangent;  // in scaled unknowns
    };
    // The point with its tangent, oriented along `ahead`; without it the sign is arbitrary.
    [[nodiscard]] Here at(const OrbitPoint& point, const Eigen::VectorXd& ahead = {}) const;
    // The next point. A step that fails or turns the tangent too far is halved; one that turns it little
    // lengthens the next. None if the steps become too short.
    [[nodiscard]] std::optional<Here> next(const Here& here, double longest);

    // From place to place, in shares of the window.
    [[nodiscard]] Eigen::Vector2d plane_way(const OrbitPoint& from, const OrbitPoint& to) const {
        return {(to.place.column - from.place.column) / window_.column,
                (to.place.row - from.place.row) / window_.row};
    }

    void set_step(double step) { step_ = step; }
    [[nodiscard]] double step() const { return step_; }
    // The displacement of the place along a tangent, in shares of the window.
    [[nodiscard]] static PlanePoint along(const Eigen::VectorXd& tangent) {
        return {tangent[tangent.size() - 2], tangent[tangent.size() - 1]};
    }

  private:
    const Rig* rig_;
    PlanePoint window_;  // its size
    std::vector<Condition> conditions_;
    double step_ = 1e-3;
};

}  // namespace peterka::curves
