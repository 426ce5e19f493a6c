// Where a curve that is traced has the gaps that are asked for, with the events of the true motion there.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "curves/branch_step.hpp"
#include "curves/trace_curve.hpp"

namespace peterka::curves {

class GapCrossings {
  public:
    GapCrossings(Stepper stepper, Window window, CurveKind kind)
        : stepper_(std::move(stepper)), window_(std::move(window)), kind_(kind) {}

    // Those of a step; a point at such a gap belongs to the step that ends there.
    void look(const Stepper::Here& here, const OrbitPoint& there);
    [[nodiscard]] const std::vector<Crossing>& found() const { return found_; }

  private:
    [[nodiscard]] std::optional<OrbitPoint> turn(const Stepper::Here& here, const OrbitPoint& there) const;
    void look_between(const OrbitPoint& here, const OrbitPoint& there);
    [[nodiscard]] std::optional<OrbitPoint> crossing(const OrbitPoint& here, const OrbitPoint& there,
                                                     double gap) const;
    [[nodiscard]] std::optional<OrbitPoint> motion_at(double gap, const OrbitPoint& guess) const;
    [[nodiscard]] bool has_other_events(const OrbitPoint& point) const;
    [[nodiscard]] bool lies_between(const OrbitPoint& here, const OrbitPoint& there,
                                    const OrbitPoint& point) const;
    [[nodiscard]] double gap_of(const OrbitPoint& point) const {
        return coordinate(point.place, window_.gap_axis);
    }

    Stepper stepper_;
    Window window_;
    CurveKind kind_;
    std::vector<Crossing> found_;
};

}  // namespace peterka::curves
