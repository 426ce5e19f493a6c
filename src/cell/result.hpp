// What is known about one solved cell of a map, and about each of its attractors where it has many starts.
// Plain data.
//
// The same numbers come in two systems of units, as two types that do not mix: nondimensional as computed
// (CellResult, CellAttractor), and as stored in files (StoredCell, StoredAttractor); see Dimension in
// cell/quantities.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "cell/labels.hpp"

namespace peterka::cell {

enum class Units { nondimensional, of_file };

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int32_t goes_on =
    -1;  // as the last impact of any regime other than no_impact: no end is verified

// The smallest sudden change of the settled hammer's velocity after which its motion ends elsewhere
// (attractors/kicks.hpp); units are those of CellResult.
struct Kick {
    double size = unknown;      // in A0 omega; NaN: none among those tried
    double phase = unknown;     // when it acts: forcing cycles after phase 0 of the orbit's first point, 0 to q
    double tried = unknown;     // size up to which kicks were tried at all phases, in A0 omega
    std::int8_t direction = 0;  // 1 up, towards the stop; -1 down; 0 none
    double lower = unknown;     // kicks up to this size were verified to lead back, in A0 omega
};

// Of a periodic orbit's peak force or largest impact speed, by the numbers of the job
// (elasticity/orbit_elasticity.hpp), in the order of the table's rows; dimensionless.
using Elasticities = std::array<double, 12>;
inline constexpr Elasticities no_elasticities = [] {
    Elasticities none{};
    none.fill(unknown);
    return none;
}();

// Units are those of CellResult.
template <Units units>
struct Result {
    Regime regime = Regime::failed;
    Status status = Status::verified;
    Engine engine = Engine::exact;
    bool computed = true;  // false: filled from computed cells around it (refine/fill.hpp); has no own run
    bool jump = false;  // of a sweep: the force jumps between the previous point and this (regime/branch.hpp)
    std::int32_t impacts = 0;  // p of z = p/q; 0 unless periodic
    std::int32_t period =
        0;  // q of z = p/q in forcing cycles; 1 for no_impact and sustained_contact, 0 if there is none
    std::int32_t cycles = 0;  // forcing cycles integrated in total: trajectory, Newton steps and measurement
    std::int32_t observed_cycles =
        0;  // for which a chaotic or unresolved motion was followed: the claim refers to these
    double peak_force = unknown;  // F/(k A0), largest over the steady state; NaN where failed and where a rigid
                                  // stop is struck, whose forces have no bound
    double largest_displacement =
        unknown;                   // of |u| = |x - y|/A0 over the same time, an upper bound; not stored
    bool chatter = false;          // of a rigid stop: a completed chatter occurs; it counts as one impact
    double impact_rate = 0;        // impacts per forcing cycle, in any regime; NaN where failed
    double multiplier = unknown;   // largest |Floquet multiplier| of the verified orbit
    double lyapunov = unknown;     // largest Lyapunov exponent per forcing cycle; NaN for the minus infinity of
                                   // an orbit whose multiplier is 0
    double sensitivity = unknown;  // ln G, the largest growth of a start perturbation during the run
    double orbit_displacement =
        unknown;                      // (x - y)/A0 at forcing phase 0, on the orbit's point of smallest value
    double orbit_velocity = unknown;  // (x' - y')/(A0 omega) there

    // On request, over the same time as the peak force; 0 without impacts.
    double impact_speed = unknown;   // largest delta' at first touch, in A0 omega
    double impulse = unknown;        // largest of one impact, in k A0/omega
    double contact_time = unknown;   // longest time for which the stop presses in one impact, in 1/omega
    double contact_power = unknown;  // mean power that the stop takes from the relative motion, in k A0^2 omega
    double max_displacement = unknown;  // largest |u|, in A0
    // On request, for the largest force of each cycle, F/(k A0): its mean, its 95 % quantile (nearest rank),
    // and the number of cycles, which is q on an orbit.
    double peak_force_mean = unknown;
    double peak_force_q95 = unknown;
    std::int32_t window_cycles = 0;
    // Where the cell has more than one start (attractors/).
    std::int32_t attractors = 0;        // on which the starts end
    std::int32_t start_attractor = -1;  // the kept attractor on which this cell ends; -1: none
    // On request: the last forcing cycle in which the stop pressed, counted from the start; 0 if it never did.
    std::int32_t last_impact = goes_on;
    // Not stored: the trajectory's own cycles, and the number of them until errors had grown by e^20, so that
    // the start was forgotten: 0 if they never did.
    std::int32_t followed_cycles = 0;
    std::int32_t forgot_after = 0;
    Kick kick = {};  // on request, in a job without [starts]: of the orbit on which this cell ends
    Elasticities elasticities = no_elasticities;  // on request
    // Under random disturbances (noise/mean_life.hpp), in a job without [starts], in 1/omega: of a settled
    // motion.
    double mean_life = unknown;
    double mean_life_error = unknown;
    double mean_life_least = unknown;
    // Of the rigs drawn for the cell (attractors/outcomes.hpp); the quantiles have the file's units in both
    // types.
    std::int32_t outcomes = 0;   // different ones
    double outcome_others = 0;   // probability of those beyond the ones kept
    double drawn_q05 = unknown;  // quantiles of the peak force F/(m g0) or, on a rigid stop, of the largest
    double drawn_q50 = unknown;  // impact speed [m/s]
    double drawn_q95 = unknown;
    // What is proved about the cell (certificate/certify.hpp); these numbers have the file's units in both
    // types, since a bound must not be rounded again.
    Certified certified = Certified::not_tried;
    double force_lower = unknown;  // of the largest force F/(m g0)
    double force_upper = unknown;
    double impact_speed_lower = unknown;  // of the largest impact speed on a rigid stop [m/s]
    double impact_speed_upper = unknown;
    double stability_margin = unknown;  // lower bound of min(1 - |det M|, 1 + det M - |tr M|)
};

// One of the attractors on which the starts of a cell end; units are those of CellAttractor.
template <Units units>
struct Attractor {
    Regime regime = static_cast<Regime>(regime_not_computed);
    Status status = static_cast<Status>(regime_not_computed);
    std::int32_t impacts = -1;
    std::int32_t period = -1;
    double peak_force = unknown;  // F/(k A0)
    double share = 0;             // of the cell's starts
    // For chaos from which starts of the cell were seen to escape, and under random disturbances for settled
    // motions: its mean life and the standard error of the mean life, in 1/omega; and where none was seen to
    // end, how long it is at least, roughly.
    double mean_life = unknown;
    double mean_life_error = unknown;
    double mean_life_least = unknown;
    // On request, for periodic attractors.
    Kick kick = {};
    double orbit_displacement = unknown;  // as in a cell's result
    double orbit_velocity = unknown;
    // On request: what is proved about it, in the units of a cell's result; no value in empty or filled slots.
    Certified certified = static_cast<Certified>(regime_not_computed);
    double force_lower = unknown;
    double force_upper = unknown;
    double impact_speed_lower = unknown;
    double impact_speed_upper = unknown;
    double stability_margin = unknown;
};

// What some of the rigs drawn for a cell end in; the same in both types.
template <Units units>
struct Outcome {
    Regime regime = static_cast<Regime>(regime_not_computed);
    std::int32_t impacts = -1;
    std::int32_t period = -1;
    double probability = 0;
};

// As stored in files: peak forces over the hammer's weight, F/(m g0); all others in SI.
using CellResult = Result<Units::nondimensional>;
using StoredCell = Result<Units::of_file>;
using CellAttractor = Attractor<Units::nondimensional>;
using StoredAttractor = Attractor<Units::of_file>;
using CellOutcome = Outcome<Units::nondimensional>;
using StoredOutcome = Outcome<Units::of_file>;

inline constexpr std::int64_t kept_outcomes = 8;  // of a cell, the most likely

// Whether two cells have the same label.
template <Units a_units, Units b_units>
bool same_label(const Result<a_units>& a, const Result<b_units>& b) {
    return a.regime == b.regime && a.impacts == b.impacts && a.period == b.period;
}

// Whether a motion of this regime is periodic, so that its numbers do not depend on a window.
inline bool has_period(Regime regime) {
    return regime == Regime::no_impact || regime == Regime::periodic || regime == Regime::sustained_contact;
}

// Whether a result of this regime identifies a motion: an unresolved or failed one may be on any.
inline bool is_motion(Regime regime) {
    return regime != Regime::unresolved && regime != Regime::failed;
}

}  // namespace peterka::cell
