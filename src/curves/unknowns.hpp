// The positions of an orbit's unknowns in a vector: for each event its time and, unless it grazes, its
// velocity; then the coordinates of the place.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/rig.hpp"

namespace peterka::curves {

class Unknowns {
  public:
    explicit Unknowns(const Orbit& orbit) {
        for (const Event& event : orbit.events) {
            times_.push_back(size_);
            size_ += event.kind == EventKind::graze ? 1 : 2;
        }
        size_ += 2;
    }

    [[nodiscard]] Eigen::Index size() const { return size_; }
    [[nodiscard]] Eigen::Index time(std::size_t event) const { return times_[event]; }
    [[nodiscard]] Eigen::Index velocity(std::size_t event) const { return times_[event] + 1; }
    [[nodiscard]] Eigen::Index column() const { return size_ - 2; }
    [[nodiscard]] Eigen::Index row() const { return size_ - 1; }

  private:
    std::vector<Eigen::Index> times_;
    Eigen::Index size_ = 0;
};

// An orbit at its place: a point on a branch or a curve.
struct OrbitPoint {
    Orbit orbit;
    PlanePoint place;
};

// Adds a step to all unknowns of a point.
inline void move(OrbitPoint& point, const Eigen::VectorXd& step) {
    const Unknowns unknowns(point.orbit);
    for (std::size_t i = 0; i < point.orbit.events.size(); ++i) {
        Event& event = point.orbit.events[i];
        event.time += step[unknowns.time(i)];
        if (event.kind != EventKind::graze) event.velocity += step[unknowns.velocity(i)];
    }
    point.place.column += step[unknowns.column()];
    point.place.row += step[unknowns.row()];
}

}  // namespace peterka::curves
