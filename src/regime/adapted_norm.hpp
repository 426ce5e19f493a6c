// A norm in which a stable linear map of the plane contracts at every step, however much it stretches vectors
// transiently.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

class AdaptedNorm {
  public:
    // multiplier: spectral radius of the Jacobian, below 1.
    AdaptedNorm(const Eigen::Matrix2d& jacobian, double multiplier);

    [[nodiscard]] double operator()(const Point& x) const { return std::sqrt(x.dot(metric_ * x)); }
    // P in ||x||^2 = x^T P x; ||x|| is never less than the Euclidean norm.
    [[nodiscard]] const Eigen::Matrix2d& metric() const { return metric_; }
    // mu: the Jacobian maps every vector to at most mu times its norm; halfway from the multiplier to 1.
    [[nodiscard]] double contraction() const { return contraction_; }

  private:
    Eigen::Matrix2d metric_;
    double contraction_;
};

}  // namespace peterka::regime
