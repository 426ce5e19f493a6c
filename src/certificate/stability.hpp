// Stability of an orbit from an enclosure of its monodromy matrix: Jury's conditions |det M| < 1 and
// tr M| < 1 + det M hold exactly if both Floquet multipliers lie inside the unit circle.
//
// M is the product of the legs' flows and, at each touch, where the force jumps by chi delta', of the saltation
// matrix (1 0; -chi 1), at each bounce of a rigid stop of (-r 0; (1 + r) a/w -r), w being the speed before it
// and a the acceleration of a hammer at rest there (Leine & Nijmeijer 2004); at release and resumed contact the
// force is continuous, and so is the flow's derivative. All events cross their surfaces transversally, so that
// the flow is smooth around the orbit.
#pragma once

#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct Multipliers {  // of the monodromy matrix M
    Interval determinant;
    Interval trace;
};
[[nodiscard]] Multipliers multipliers(const Springs<Interval>& springs, const EventChain& chain,
                                      const std::vector<Place<Interval>>& places);

// A lower bound of min(1 - |det M|, 1 + det M - |tr M|): positive if the orbit is stable.
[[nodiscard]] double stability_margin(const Interval& determinant, const Interval& trace);
[[nodiscard]] double stability_margin(const Springs<Interval>& springs, const EventChain& chain,
                                      const std::vector<Place<Interval>>& places);

}  // namespace peterka::certificate
