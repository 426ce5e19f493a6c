// How long chaotic motion must last, in a given oscillator, before it is called chaos.
//
// The claim covers only the cycles observed. Where a motion without impacts is possible too (steady free
// amplitude below the gap, or a lasting contact), the chaos may be a long transient, and chaos_cycles are
// required; elsewhere 0.3 of them. Either way more are required in an oscillator that loses little in a cycle,
// as transients live as long as areas take to shrink; and, where impacts never cease, more if Newton's method
// finds a stable orbit nearby.
#pragma once

#include <algorithm>
#include <cstdint>

#include "job/job.hpp"
#include "regime/growth.hpp"

namespace peterka::regime {

class ChaosClaim {
  public:
    // Nearby orbits are sought up to this period.
    static constexpr std::int64_t longest_orbit_near = 4;

    // may_settle: a motion without impacts, or with a permanent contact, is possible as far as is known.
    ChaosClaim(const job::SteadyState& budget, bool may_settle)
        : forever_cycles_(budget.chaos_cycles * 3 / 10),
          fewest_cycles_(may_settle ? budget.chaos_cycles : forever_cycles_),
          looks_for_orbits_(!may_settle) {}

    // Whether a trajectory with this growth looks chaotic. After two resets it repeats, possibly with a period
    // beyond max_period, however irregular it looks.
    [[nodiscard]] static bool looks_chaotic(const Growth& growth) {
        return growth.resets() <= 1 && growth.surely_positive();
    }
    [[nodiscard]] bool lasted_long_enough(const Growth& growth, std::int64_t cycles) const {
        return static_cast<double>(cycles) >= cycles_asked(growth.dissipation());
    }
    // Upper bound on the cycles required at this dissipation per cycle, whatever else is known of the
    // oscillator.
    [[nodiscard]] static double most_cycles(const job::SteadyState& budget, double dissipation) {
        auto most = static_cast<double>(budget.chaos_cycles);
        for (const bool may_settle : {true, false}) {
            ChaosClaim claim(budget, may_settle);
            if (!may_settle && !(dissipation > forgets_at_once)) claim.wait_beside_an_orbit();
            most = std::max(most, claim.cycles_asked(dissipation));
        }
        return most;
    }
    // Whether to search first for stable orbits on which the chaos may still end; true at most once.
    [[nodiscard]] bool asks_for_orbits(const Growth& growth) {
        const bool asks = looks_for_orbits_ && !(growth.dissipation() > forgets_at_once);
        looks_for_orbits_ = false;
        return asks;
    }
    void wait_beside_an_orbit() { patience_ = patience_beside_an_orbit; }

  private:
    // Lifetimes of chaotic transients scale with the time in which areas shrink, and scatter over decades: of
    // 2,200 chaotic cells of 45 random rigs with damping ratios from 0.002 to 0.05 and restitutions from 0.25
    // to 0.97, 5 % settled between 600 such times and 20,000 cycles, two thirds of them on orbits of period 1
    // to 4.
    static constexpr double areas_per_wait = 2.0;   // required e-foldings of the area per forever cycle
    static constexpr double forgets_at_once = 1.2;  // per cycle; above it few settle later
    static constexpr double patience_beside_an_orbit = 4;

    [[nodiscard]] double cycles_asked(double dissipation) const {
        const double by_dissipation = static_cast<double>(forever_cycles_) * areas_per_wait / dissipation;
        return patience_ * std::max(static_cast<double>(fewest_cycles_), by_dissipation);
    }

    std::int64_t forever_cycles_;  // where impacts never cease
    std::int64_t fewest_cycles_;
    bool looks_for_orbits_;
    double patience_ = 1;
};

}  // namespace peterka::regime
