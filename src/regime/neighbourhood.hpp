// A neighbourhood of a point on a stable periodic orbit: every state in it converges to the orbit.
//
// It is an ellipse, a disc in the norm adapted to the orbit's Jacobian J (regime/adapted_norm.hpp). Ellipses
// are tried from small to large: q cycles must map the whole boundary of each into (1 + mu)/2 of its size, with
// the contacts of the orbit, mu being the contraction factor of J. So the distance shrinks from every size to
// the next smaller one, down to where J alone decides. Half of the largest such ellipse is used: a border of
// other contacts that enters between two samples of the boundary would cut deeper than to half its size only if
// it missed a third of all samples.
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
    // Largest distance of its points from the centre along each axis.
    [[nodiscard]] const Point& reach() const { return reach_; }
    // The boundary point at an angle; equal steps of the angle are equally spaced in the norm.
    [[nodiscard]] Point boundary(double angle) const;

  private:
    Point centre_;
    Eigen::Matrix2d shape_;  // x^T shape x = 1 on the boundary
    Point reach_;
};

// Approximate number of cycles needed to find a neighbourhood of one point of an orbit of period q.
[[nodiscard]] constexpr std::int64_t cycles_for_neighbourhood(std::int64_t q) {
    return 300 * q;
}

// Neighbourhoods of `count` points of a stable orbit, spread evenly over its q points, starting from one of
// them; fewer if no ellipse of useful size could be proved.
[[nodiscard]] Task<std::vector<Neighbourhood>> find_neighbourhoods(StroboscopicMap& map, Point orbit_point,
                                                                   std::int64_t q, std::int64_t count);

}  // namespace peterka::regime
