// What is known about one cell of a map once it is solved, and about each of its attractors where it has many
// starts. Plain data.
//
// The same numbers come in two kinds of units, and so in two types that don't mix: nondimensional as they are
// computed (CellResult, CellAttractor), and as files hold them (StoredCell, StoredAttractor), see Dimension in
// cell/quantities.hpp.
#pragma once

#include <cstdint>
#include <limits>

#include "cell/labels.hpp"

namespace peterka::cell {

enum class Units { nondimensional, of_file };

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int32_t goes_on =
    -1;  // as the last impact of any regime but no_impact: no end is verified

// The smallest sudden change of the settled hammer's velocity after which its motion ends elsewhere
// (attractors/kicks.hpp); units are told for CellResult.
struct Kick {
    double size = unknown;      // in A0 omega; NaN: none that was tried
    double phase = unknown;     // when it acts: forcing cycles after phase 0 of the orbit's first point, 0 to q
    double tried = unknown;     // up to which size kicks were tried at all phases, in A0 omega
    std::int8_t direction = 0;  // 1 up, towards the stop; -1 down; 0 none
    double lower = unknown;     // kicks up to this size were verified to lead back, in A0 omega
};

// Units are told for CellResult.
template <Units units>
struct Result {
    Regime regime = Regime::failed;
    Status status = Status::verified;
    Engine engine = Engine::exact;
    bool computed = true;  // false: filled from computed cells around it (refine/fill.hpp); no run of its own
    bool jump = false;  // of a sweep: the force jumps on the way here from the point before (regime/branch.hpp)
    std::int32_t impacts = 0;  // p of z = p/q; 0 unless periodic
    std::int32_t period =
        0;  // q of z = p/q in forcing cycles; 1 for no_impact and sustained_contact, 0 if none
    std::int32_t cycles = 0;  // forcing cycles integrated in all: trajectory, Newton steps and measurement
    std::int32_t observed_cycles =
        0;  // for which a chaotic or unresolved motion was followed: what the claim speaks of
    double peak_force = unknown;  // F/(k A0), largest over the steady state; NaN where failed and where a rigid
                                  // stop is struck, whose forces have no bound
    double largest_displacement =
        unknown;                   // of |u| = |x - y|/A0 over the same time, an upper bound; not stored
    bool chatter = false;          // of a rigid stop, completed; it counts as one impact
    double impact_rate = 0;        // impacts per forcing cycle, any regime; NaN where failed
    double multiplier = unknown;   // largest |Floquet multiplier| of the verified orbit
    double lyapunov = unknown;     // largest Lyapunov exponent per forcing cycle; NaN for the minus infinity of
                                   // an orbit whose multiplier is 0
    double sensitivity = unknown;  // ln G, the largest growth of a start perturbation during the run
    double orbit_displacement =
        unknown;                      // (x - y)/A0 at forcing phase 0, on the orbit's point of smallest value
    double orbit_velocity = unknown;  // (x' - y')/(A0 omega) there

    // On request, over the same time as the peak force; 0 where nothing impacts.
    double impact_speed = unknown;   // largest delta' at first touch, in A0 omega
    double impulse = unknown;        // largest of one impact, in k A0/omega
    double contact_time = unknown;   // longest time for which the stop presses in one impact, in 1/omega
    double contact_power = unknown;  // mean power that the stop takes from the relative motion, in k A0^2 omega
    double max_displacement = unknown;  // largest |u|, in A0
    // On request, of the largest force of each cycle, F/(k A0): mean, 95 % quantile (nearest rank), and of how
    // many cycles; of the q cycles of an orbit.
    double peak_force_mean = unknown;
    double peak_force_q95 = unknown;
    std::int32_t window_cycles = 0;
    // Where the cell has more starts than one (attractors/).
    std::int32_t attractors = 0;        // on which these end
    std::int32_t start_attractor = -1;  // on which of those that are kept this cell ends; -1: on none
    // On request: the last forcing cycle in which the stop pressed, counted from the start; 0 if it never did.
    std::int32_t last_impact = goes_on;
    // Not stored: the trajectory's own cycles, and how many of them it took until errors had grown by e^20, the
    // start being forgotten: 0 if they never did.
    std::int32_t followed_cycles = 0;
    std::int32_t forgot_after = 0;
    Kick kick = {};  // on request, of a job without [starts]: of the orbit on which this cell ends
    // What is proved of it (certificate/certify.hpp); the numbers are those of the file in either kind of
    // units, for a bound must not be rounded again.
    Certified certified = Certified::not_tried;
    double force_lower = unknown;  // of the largest F/(m g0)
    double force_upper = unknown;
    double stability_margin = unknown;  // lower bound of min(1 - |det M|, 1 + det M - |tr M|)
};

// One of the attractors on which the starts of a cell end; units are told for CellAttractor.
template <Units units>
struct Attractor {
    Regime regime = static_cast<Regime>(regime_not_computed);
    Status status = static_cast<Status>(regime_not_computed);
    std::int32_t impacts = -1;
    std::int32_t period = -1;
    double peak_force = unknown;  // F/(k A0)
    double share = 0;             // of the cell's starts
    // Of chaos from which starts of the cell were seen to escape: its mean life and the standard error of that,
    // in 1/omega.
    double mean_life = unknown;
    double mean_life_error = unknown;
    // On request, of periodic ones.
    Kick kick = {};
    double orbit_displacement = unknown;  // as of a cell
    double orbit_velocity = unknown;
};

// As files hold them: peak forces over the hammer's weight, F/(m g0); the rest in SI.
using CellResult = Result<Units::nondimensional>;
using StoredCell = Result<Units::of_file>;
using CellAttractor = Attractor<Units::nondimensional>;
using StoredAttractor = Attractor<Units::of_file>;

// Whether two cells are called the same.
template <Units a_units, Units b_units>
bool same_label(const Result<a_units>& a, const Result<b_units>& b) {
    return a.regime == b.regime && a.impacts == b.impacts && a.period == b.period;
}

// Whether a motion of this regime repeats itself, so that its numbers depend on no window.
inline bool has_period(Regime regime) {
    return regime == Regime::no_impact || regime == Regime::periodic || regime == Regime::sustained_contact;
}

// Whether a result of this regime tells a motion: those that are unresolved or failed may be on any.
inline bool is_motion(Regime regime) {
    return regime != Regime::unresolved && regime != Regime::failed;
}

}  // namespace peterka::cell
