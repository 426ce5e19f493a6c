// A neighbourhood of a point on a stable periodic orbit from which every state converges to the orbit.
//
// It is an ellipse, a disc in the norm adapted to the orbit's Jacobian J (regime/adapted_norm.hpp). Ellipses
// are tried from small to large: each must be carried by q cycles into (1 + mu)/2 of its size, along its whole
// boundary and with the contacts of the orbit, mu being what J contracts. So the distance shrinks from every
// size to the next smaller one, down to where J alone decides. Of the largest ellipse that does, half is used:
// a border of other contacts that came in between two samples of the boundary would cut deeper than to half its
// size only if it missed a third of all samples.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "regime/stroboscopic_map.hpp"
#include "support/task.hpp"

namespace peterka::regime {

class Neighbourhood {
  public:
    // radius: of the disc in the norm whose square is x^T metric x.
    Neighbourhood(Point centre, const Eigen::Matrix2d& metric, double radius);

    [[nodiscard]] bool contains(const Point& x) const {
        const double a = x[0] - centre_[0];
        const double b = x[1] - centre_[1];
        if (!(std::abs(a) <= reach_[0] && std::abs(b) <= reach_[1])) return false;
        return a * (shape_(0, 0) * a + 2 * shape_(0, 1) * b) + shape_(1, 1) * b * b <= 1;
    }
    [[nodiscard]] const Point& centre() const { return centre_; }
    // Largest distance of its points from the centre in each direction.
    [[nodiscard]] const Point& reach() const { return reach_; }
    // The point of the boundary at an angle: by equal steps of angle they go round evenly in the norm.
    [[nodiscard]] Point boundary(double angle) const;

  private:
    Point centre_;
    Eigen::Matrix2d shape_;  // x^T shape x = 1 on the boundary
    Point reach_;
};

// Cycles that it takes to find a neighbourhood for one point of an orbit of period q, about.
[[nodiscard]] constexpr std::int64_t cycles_for_neighbourhood(std::int64_t q) {
    return 300 * q;
}

// Neighbourhoods of some points of a stable orbit, spread evenly over its q points, from one of them; fewer
// where no ellipse worth the while could be proved.
[[nodiscard]] Task<std::vector<Neighbourhood>> find_neighbourhoods(StroboscopicMap& map, Point orbit_point,
                                                                   std::int64_t q, std::int64_t count);

}  // namespace peterka::regime
