// Proof that a chain of events exists, by the Krawczyk operator of its equations.
//
// R. Krawczyk (Computing 4, 1969) and R. E. Moore (SIAM J. Numer. Anal. 14, 1977): for G(x) = 0, a point m of a
// box X, any matrix C and an enclosure A of the derivatives of G on X, if m - C G(m) + (I - C A)(X - m) lies
// inside X, then X contains exactly one solution, and so does that expression.
#pragma once

#include <optional>
#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

// A box with exactly one solution for each rig within the enclosed numbers. nothing: not proved.
[[nodiscard]] std::optional<std::vector<Place<Interval>>> orbit_box(const Springs<Interval>& springs,
                                                                    const Springs<double>& middle,
                                                                    const EventChain& chain);

}  // namespace peterka::certificate
