// The theorem about a single cell.
//
// For a periodic cell: near the orbit given by the cell's state at forcing phase 0 there is exactly one
// periodic orbit of the equation of motion; its smallest period is q cycles, it touches the stop p times in
// them, meets no event but those of its chain, is asymptotically stable, and its largest force lies between two
// bounds; against a rigid stop, whose forces have none, its largest impact speed does. For no impact and
// sustained contact: the steady motion stays away from the stop, or against it, and attracts.
//
// The statement concerns the complete equation with the job's numbers and the cell's coordinates, all exact
// doubles. From previous computations it takes only the cell's label and state, as a guess.
#pragma once

#include <optional>

#include "cell/labels.hpp"
#include "certificate/find_chain.hpp"
#include "job/cell_numbers.hpp"

namespace peterka::certificate {

struct Claim {
    cell::Regime regime = cell::Regime::unresolved;
    StroboscopicOrbit orbit;  // where it is periodic
};

// Where the motion from a cell's start has settled, in doubles: a guess.
struct SettledStart {
    double displacement = 0;  // (x - y)/A0 at a forcing phase 0
    double velocity = 0;      // (x' - y')/(A0 omega) there
    double cycles = 0;        // from the start to the last event known before [forcing cycles]
};

struct Certificate {
    cell::Certified verdict = cell::Certified::not_tried;
    Interval force_ratio = nothing();   // the largest force F/(m g0); nothing() where a rigid stop is struck
    Interval impact_speed = nothing();  // of a rigid stop, the largest [m/s]
    double stability_margin = 0;        // lower bound (stability.hpp)
    double last_event =
        0;  // of no impact, where the start is proved to lead there: cycles up to its last event
    // Where the start does not lead to the motion claimed: found while its way was followed.
    std::optional<SettledStart> elsewhere = {};
    [[nodiscard]] bool proved() const { return verdict > cell::Certified::not_tried; }
};

enum class OfStart { if_it_keeps_its_phase, through_impacts, in_many_digits };

// `of_start`: how far the motion from the cell's start is followed, in order to prove that it leads there: up
// to its first impact or release, or through all of them (start_way.hpp), with many digits where doubles lose
// the way.
[[nodiscard]] Certificate certify(const job::CellNumbers& numbers, const Claim& claim,
                                  OfStart of_start = OfStart::if_it_keeps_its_phase);

}  // namespace peterka::certificate
