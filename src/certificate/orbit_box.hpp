// Proof that a chain of events exists, by the Krawczyk operator of its equations.
//
// R. Krawczyk (Computing 4, 1969) and R. E. Moore (SIAM J. Numer. Anal. 14, 1977): for G(x) = 0, a point m of a
// box X, any matrix C and an enclosure A of the derivatives of G on X, if m - C G(m) + (I - C A)(X - m) lies
// inside X, then X contains exactly one solution, and so does that expression. It depends continuously on the
// numbers of the rig, since the derivatives are nowhere singular.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct EnclosedOrbits {
    std::vector<Place<Interval>> places;
    std::vector<Place<Interval>> alone;  // a larger box, with no other solution
};

// Exactly one solution for each rig within the enclosed numbers. nothing: not proved.
[[nodiscard]] std::optional<EnclosedOrbits> enclosed_orbits(const Springs<Interval>& springs,
                                                            const Springs<double>& middle,
                                                            const EventChain& chain);
[[nodiscard]] std::optional<std::vector<Place<Interval>>> orbit_box(const Springs<Interval>& springs,
                                                                    const Springs<double>& middle,
                                                                    const EventChain& chain);

// Near a fold the derivatives are nearly singular. With one of the unknowns held at a value s, and mu added to
// one of the equations as the unknown in its place, they are not, and the chains that close up to mu form a
// smooth family, mu(s): closed ones are its zeros, and where mu = 0 and mu' = 0 the derivatives are singular
// (H. B. Keller, in Applications of Bifurcation Theory, Academic Press 1977). The equations are linear in mu,
// so that a box has no other solution whatever its mu.
struct Relaxation {
    std::size_t unknown = 0;   // 2 i: the time of event i, 2 i + 1: its coordinate
    std::size_t equation = 0;  // 2 i, 2 i + 1: of leg i
    Interval held;             // s, all of these values
};

struct RelaxedOrbits {
    EnclosedOrbits orbits;
    Interval slack;  // mu
    Interval slope;  // mu'
};

// Exactly one solution for each s within `held` and each rig within the enclosed numbers. The chain's own value
// of that unknown is not used.
[[nodiscard]] std::optional<RelaxedOrbits> relaxed_orbits(const Springs<Interval>& springs,
                                                          const Springs<double>& middle,
                                                          const EventChain& chain,
                                                          const Relaxation& relaxation);

}  // namespace peterka::certificate
