// How a small change of the state grows over one period of an orbit: the product M of flows and saltations,
// beginning just before the first event.
#pragma once

#include <Eigen/Core>

#include "curves/rig.hpp"

namespace peterka::curves {

// Which side of a grazing: the orbit that passes by, or that with the impact.
enum class Side : std::uint8_t { without_impact, with_impact };

struct Monodromy {
    Jacobian<double> matrix;
    double determinant = 0;  // of the matrix, without cancellation

    // det(M - sign I): 0 where a multiplier is sign.
    [[nodiscard]] double bifurcation(int sign) const { return 1 - sign * matrix.trace() + determinant; }
    // The multiplier that is largest in size, with the sign of its real part.
    [[nodiscard]] double multiplier() const;
    [[nodiscard]] bool is_stable() const { return std::abs(multiplier()) < 1; }
};

[[nodiscard]] Monodromy monodromy(const Rig& rig, const Orbit& orbit, const PlanePoint& place, Side side);

// 0 where a multiplier is sign, and its derivatives by the unknowns (unknowns.hpp): det(M - sign I), times the
// speed of each impact on a rigid stop over the largest one or the cart's, without which it has no limit at a
// grazing; and over the size of the factors that M is made of. They reach 1e4 where weak impacts follow each
// other, and cancel in M, so that the last digit of each of them moves det(M - sign I) by as many times its
// own.
struct Bifurcation {
    double value = 0;
    Eigen::VectorXd gradient;
};
[[nodiscard]] Bifurcation bifurcation(const PlacedRig& rig, const Orbit& orbit, int sign, Side side);

}  // namespace peterka::curves
