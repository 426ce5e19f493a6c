// The monodromy matrix M of an orbit: the product of flows and saltation matrices over one period, beginning
// just before the first event (Leine & Nijmeijer 2004).
#pragma once

#include <Eigen/Core>

#include "curves/rig.hpp"

namespace peterka::curves {

// The side of a grazing: the orbit that misses the stop, or the one with the impact.
enum class Side : std::uint8_t { without_impact, with_impact };

struct Monodromy {
    Jacobian<double> matrix;
    double determinant = 0;  // of the matrix, computed without cancellation

    // det(M - sign I), which is 0 where a multiplier equals sign.
    [[nodiscard]] double bifurcation(int sign) const { return 1 - sign * matrix.trace() + determinant; }
    // The Floquet multiplier of largest modulus, as this modulus with the sign of its real part.
    [[nodiscard]] double multiplier() const;
    [[nodiscard]] bool is_stable() const { return std::abs(multiplier()) < 1; }
};

[[nodiscard]] Monodromy monodromy(const Rig& rig, const Orbit& orbit, const PlanePoint& place, Side side);

// det(M - sign I) times each impact speed on a rigid stop, in units of the frequency: smooth along a branch of
// orbits, also where such a speed vanishes and M has a pole (Nordmark 1991).
[[nodiscard]] double smooth_bifurcation(const Rig& rig, const Orbit& orbit, const PlanePoint& place, int sign,
                                        Side side);

// A test function, 0 where a multiplier equals sign, and its gradient by the unknowns (unknowns.hpp). It is
// det(M - sign I), times v / max(v, v_graze) for each impact speed v on a rigid stop, since M grows as 1/v at a
// grazing (Nordmark 1991), and divided by the size of M's factors. These reach 1e4 in sequences of weak impacts
// and cancel in M, so that their rounding errors reach det(M - sign I) amplified by as much. max(v, v_graze)
// and the size count as constants in the gradient.
struct Bifurcation {
    double value = 0;
    Eigen::VectorXd gradient;
};
[[nodiscard]] Bifurcation bifurcation(const PlacedRig& rig, const Orbit& orbit, int sign, Side side);

}  // namespace peterka::curves
