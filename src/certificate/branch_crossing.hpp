// The theorem about a crossing: where, as one number of the job changes, a periodic orbit folds, doubles its
// period or grazes the stop.
//
// Let lambda be that number, and all others exact. A chain of events whose equations have exactly one solution
// in a box for each lambda of an interval has a branch of orbits there that is continuous in lambda
// (orbit_box.hpp). A continuous function on the interval has a zero where its signs at the ends differ, and
// each kind of crossing is a zero of one:
//
//     period doubling   f = det(M + I) = 1 + tr M + det M of the orbit: a multiplier is -1 (stability.hpp);
//     grazing           f = delta at a turning point, delta' = 0, of the chain: where it is 0, the equations
//                       are those of a motion that grazes;
//     fold              f = max over s in S of +-mu(s), for one of the orbit's unknowns, s, and the slack mu of
//                       a chain relaxed at s. If +-mu' is surely positive at the lower end of S and negative at
//                       the upper one, for all lambda, the maximum lies inside S, where mu' = 0; if it is 0,
//                       the orbit is closed and has the multiplier 1.
//
// Theorem, if `proved`. For at least one lambda in [lower, upper], ends included, the equation of motion has a
// periodic orbit that meets exactly the events of the chain, in this order and each transversally; q is its
// smallest period; and at a fold it has the multiplier 1, at a period doubling -1, while at a grazing one
// flight has delta = delta' = 0 at the event in question, with delta'' < 0 (or, where the stop has released the
// hammer before and now presses again, with delta'' > 0). Not part of it: that there is only one such lambda,
// and that the orbit is stable elsewhere.
//
// The statement concerns the complete equation, with its cubic spring, and lambda in the job's own unit.
// Whatever else is given is a guess, from where the chain is refined in doubles.
#pragma once

#include <cstdint>
#include <string>

#include "certificate/find_chain.hpp"
#include "certificate/orbit_box.hpp"
#include "job/cell_numbers.hpp"

namespace peterka::certificate {

enum class BranchEvent : std::int8_t { fold, period_doubling, grazing };

// Stored as int8; the numbers are part of the file format. Where one means the same as for a cell it is that of
// cell::Certified.
enum class Crossed : std::int8_t {
    not_surely_crossed = -7,  // the function's signs do not surely differ within any interval tried
    near_grazing = -6,        // cannot be distinguished from a motion with one more contact, or one fewer
    no_orbit_enclosed = -5,   // no box holds exactly one orbit throughout the interval
    other_label = -4,         // the orbit has a smaller period
    no_orbit_found = -3,      // the search in doubles does not converge
    other_stop = -2,          // no theorem for this law of the stop
    cubic_spring = -1,        // the cubic term is too strong for the bounds used by the proof
    not_tried = 0,
    proved = 1,
};
inline constexpr int first_crossed = -7;

struct BranchCrossing {
    BranchEvent event = BranchEvent::fold;
    EventChain chain;  // a grazing's has one event that grazes, the others none
    std::string key;   // of lambda, as in job/axis_quantity.hpp
    double near = 0;   // lambda, approximately
};

struct CrossingProof {
    Crossed verdict = Crossed::not_tried;
    Interval at = nothing();  // [lower, upper], in the unit of the key
    [[nodiscard]] bool proved() const { return verdict == Crossed::proved; }
};

// numbers: of the job, with those of its place that do not change.
[[nodiscard]] CrossingProof prove_crossing(const job::CellNumbers& numbers, const BranchCrossing& found);

// Whether the theorem is proved for this interval.
[[nodiscard]] Crossed crosses_within(const job::CellNumbers& numbers, const BranchCrossing& found,
                                     const Interval& within);

// How a chain is relaxed at a fold: what is held are all s in S, and mu times the sign has a maximum.
struct Fold {
    Relaxation relaxation;
    double sign = 1;

    [[nodiscard]] Relaxation held_at(double s) const {
        return {relaxation.unknown, relaxation.equation, Interval(s)};
    }
    [[nodiscard]] double middle() const { return relaxation.held.middle(); }
};

// The same for a fold with a given S; the events must be those of the job's stop.
[[nodiscard]] Crossed folds_within(const job::CellNumbers& numbers, const BranchCrossing& found,
                                   const Fold& fold, const Interval& within);

}  // namespace peterka::certificate
