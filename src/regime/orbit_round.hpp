// Newton's method for all q points of a periodic orbit at once (multiple shooting, Morrison, Riley & Zancanaro
// 1962): each cycle begins at its own point, so that no error grows along the orbit, and the mismatch with the
// next point is seen at every phase.
//
// With x_i the points, M the stroboscopic map, J_i its Jacobian at x_i and r_i = M(x_i) - x_(i+1), cyclic, the
// corrections d_i obey d_(i+1) = J_i d_i + r_i. Hence (I - J) d_0 = a with J = J_(q-1) ... J_0 and a the
// accumulated r_i; the other d_i follow from d_0.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

// A round of cycles, one from each point.
class OrbitRound {
  public:
    explicit OrbitRound(std::int64_t period) { steps_.reserve(static_cast<std::size_t>(period)); }

    // Adds the cycle from the next point; `following`: the point that comes after it on the orbit.
    void add(const CycleResult& cycle, const Point& following);

    // Applies Newton's corrections to the points, in the order of their cycles; returns the largest relative
    // move. None, with the points unchanged, if a move is too large.
    [[nodiscard]] std::optional<double> correct(Points& points) const;

    [[nodiscard]] const Eigen::Matrix2d& jacobian() const { return jacobian_; }  // J
    // Largest norm of a single cycle's Jacobian, at least 1.
    [[nodiscard]] double largest_stretch() const { return largest_stretch_; }
    // Pattern of the q cycles from one of the points on.
    [[nodiscard]] EventPattern pattern(std::size_t from = 0) const;
    [[nodiscard]] bool touched() const { return touched_; }
    [[nodiscard]] bool separated() const { return separated_; }

  private:
    struct Step {
        Eigen::Matrix2d jacobian;
        Point residual;
        EventPattern pattern;
    };
    std::vector<Step, ReusingAllocator<Step>> steps_;
    Eigen::Matrix2d jacobian_ = Eigen::Matrix2d::Identity();
    Point residual_ = Point::Zero();  // a
    double largest_stretch_ = 1;
    bool touched_ = false;
    bool separated_ = false;
};

}  // namespace peterka::regime
