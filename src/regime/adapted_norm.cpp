#include "regime/adapted_norm.hpp"

#include <Eigen/Dense>

namespace peterka::regime {

// The metric P = sum over k of ((J/mu)^k)^T (J/mu)^k solves P - (J/mu)^T P (J/mu) = I (Stein equation), so that
// ||J x|| <= mu ||x||.
AdaptedNorm::AdaptedNorm(const Eigen::Matrix2d& jacobian, double multiplier)
    : contraction_((1 + multiplier) / 2) {
    const Eigen::Matrix2d j = jacobian / contraction_;
    Eigen::Matrix3d system;
    system << 1 - j(0, 0) * j(0, 0), -2 * j(0, 0) * j(1, 0), -j(1, 0) * j(1, 0),            //
        -j(0, 0) * j(0, 1), 1 - j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0), -j(1, 0) * j(1, 1),  //
        -j(0, 1) * j(0, 1), -2 * j(0, 1) * j(1, 1), 1 - j(1, 1) * j(1, 1);
    const Eigen::Vector3d p = system.partialPivLu().solve(Eigen::Vector3d(1, 0, 1));
    metric_ << p[0], p[1], p[1], p[2];
}

}  // namespace peterka::regime
