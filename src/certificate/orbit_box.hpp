// The proof that a chain of events exists: Krawczyk's operator on its equations.
//
// R. Krawczyk (Computing 4, 1969) and R. E. Moore (SIAM J. Numer. Anal. 14, 1977): of G(x) = 0, a point m of a
// box X, any matrix C and an enclosure A of the derivatives of G on X, if m - C G(m) + (I - C A)(X - m) lies
// inside X, then X holds exactly one solution, and that expression does, too.
#pragma once

#include <optional>
#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

// Holds exactly one solution for each rig within the enclosed numbers. nothing: it wasn't proved.
[[nodiscard]] std::optional<std::vector<Place<Interval>>> orbit_box(const Springs<Interval>& springs,
                                                                    const Springs<double>& middle,
                                                                    const EventChain& chain);

}  // namespace peterka::certificate
