// A neighbourhood of a proved orbit from which all motions converge to it.
//
// Lemma. The return map of q cycles, from one of the orbit's events to the same one, is defined and smooth on a
// convex set around the orbit's place x*, all of whose motions meet the same events in the same order
// (patch.hpp). If in the coordinates b, x = x* + P b, the Euclidean norm of its derivative stays below 1 there,
// it maps each disc |b| <= radius within the set into itself, and all motions from the disc converge to x*.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "certificate/patch.hpp"

namespace peterka::certificate {

struct Trap {
    Event event;                   // its kind, and where it is counted from (start_way.hpp)
    Place<Interval> orbit;         // x*
    Matrix<Interval> coordinates;  // P^-1
    double radius = 0;

    // Whether all of a set is surely inside.
    [[nodiscard]] bool holds(const Patch& patch) const;
};

// The largest of a sequence of discs around an event of the orbit, whose places are proved; nothing if none can
// be proved.
[[nodiscard]] std::optional<Trap> find_trap(const Springs<Interval>& springs,
                                            const Springs<double>& approximate, const EventChain& chain,
                                            const std::vector<Place<Interval>>& places);

}  // namespace peterka::certificate
