// How the largest force of a periodic orbit, or on a rigid stop its largest impact speed, depends on the
// numbers of its rig.
//
// The orbit is a chain of events whose times and velocities X solve R(X, p) = 0 (certificate/event_chain.hpp),
// with the cubic term of the springs. So dX/dp = -(dR/dX)^-1 dR/dp; the force at first touch, or at its maximum
// within a contact, whose own shift in time doesn't matter (envelope theorem), follows by the chain rule. All
// derivatives are exact to rounding (dual.hpp). An elasticity is the relative change of the result per relative
// change of a number: 0.46 means 0.46 % per 1 %.
//
// In SI units the hammer's, the cart's and the stop's other numbers stay as the job gives them, and frequency
// and gap stay in Hz and m, as for the rigs that [uncertainty] draws (job/rig_draws.hpp).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "certificate/find_chain.hpp"
#include "elasticity/dual.hpp"
#include "job/cell_numbers.hpp"

namespace peterka::elasticity {

struct OrbitElasticity {
    double largest = 0;                                // the force, F/(k A0), or the impact speed, in A0 omega
    std::array<double, rig_numbers> by_rig_numbers{};  // of that, by each number of the nondimensional rig
};

// Nothing: the state leads to no orbit with this label, the law is Hunt and Crossley's, or the orbit is about
// to end in a fold: det(I - M) < least_determinant, M being its monodromy matrix, so that elasticities have no
// bound.
inline constexpr double least_determinant = 1e-4;
[[nodiscard]] std::optional<OrbitElasticity> orbit_elasticity(const job::CellNumbers& numbers,
                                                              const certificate::StroboscopicOrbit& orbit);

// Of the force in N or the speed in m/s, by a number of the job as axes name it; 0 where that number is 0.
[[nodiscard]] double elasticity_by(std::string_view key, const job::CellNumbers& numbers,
                                   const OrbitElasticity& of_orbit);

}  // namespace peterka::elasticity
