// How long chaos has to last, in one oscillator, until it is called so.
//
// A chaotic claim speaks of the cycles observed: where no impact is possible too (steady free amplitude below
// the gap, or a contact that lasts), it may be a long transient, and chaos_cycles are asked for. Where not, 0.3
// of them. Either way more in an oscillator that loses little in a cycle, for transients live as long as areas
// take to shrink; and, where impacts go on for ever, more where Newton's method finds a stable orbit near by.
#pragma once

#include <algorithm>
#include <cstdint>

#include "job/job.hpp"
#include "regime/growth.hpp"

namespace peterka::regime {

class ChaosClaim {
  public:
    // Orbits near by are looked for up to this period.
    static constexpr std::int64_t longest_orbit_near = 4;

    // may_settle: a motion without impacts, or without end of a contact, is possible as far as is known.
    ChaosClaim(const job::SteadyState& budget, bool may_settle)
        : forever_cycles_(budget.chaos_cycles * 3 / 10),
          fewest_cycles_(may_settle ? budget.chaos_cycles : forever_cycles_),
          looks_for_orbits_(!may_settle) {}

    // What a trajectory of this growth looks like. After two resets it repeats, be it with a period beyond
    // max_period, however wild it looks.
    [[nodiscard]] static bool looks_chaotic(const Growth& growth) {
        return growth.resets() <= 1 && growth.surely_positive();
    }
    [[nodiscard]] bool lasted_long_enough(const Growth& growth, std::int64_t cycles) const {
        return static_cast<double>(cycles) >= cycles_asked(growth.dissipation());
    }
    // Where so much is lost in a cycle, whatever else is known of the oscillator.
    [[nodiscard]] static double most_cycles(const job::SteadyState& budget, double dissipation) {
        auto most = static_cast<double>(budget.chaos_cycles);
        for (const bool may_settle : {true, false}) {
            ChaosClaim claim(budget, may_settle);
            if (!may_settle && !(dissipation > forgets_at_once)) claim.wait_beside_an_orbit();
            most = std::max(most, claim.cycles_asked(dissipation));
        }
        return most;
    }
    // Whether first, and only once, stable orbits are to be looked for on which the chaos may still end.
    [[nodiscard]] bool asks_for_orbits(const Growth& growth) {
        const bool asks = looks_for_orbits_ && !(growth.dissipation() > forgets_at_once);
        looks_for_orbits_ = false;
        return asks;
    }
    void wait_beside_an_orbit() { patience_ = patience_beside_an_orbit; }

  private:
    // Lives of chaotic transients go with the time in which areas shrink, and are scattered over decades: of
    // 2,200 chaotic cells of 45 random rigs with damping ratios from 0.002 to 0.05 and restitutions from 0.25
    // to 0.97 5 % settled between 600 such times and 20,000 cycles, two thirds of them on orbits of period 1
    // to 4.
    static constexpr double areas_per_wait = 2.0;   // e-foldings of the area in each of the fewest chaos cycles
    static constexpr double forgets_at_once = 1.2;  // per cycle; where more is lost few settle later
    static constexpr double patience_beside_an_orbit = 4;

    [[nodiscard]] double cycles_asked(double dissipation) const {
        const double by_dissipation = static_cast<double>(forever_cycles_) * areas_per_wait / dissipation;
        return patience_ * std::max(static_cast<double>(fewest_cycles_), by_dissipation);
    }

    std::int64_t forever_cycles_;  // where impacts go on for ever
    std::int64_t fewest_cycles_;
    bool looks_for_orbits_;
    double patience_ = 1;
};

}  // namespace peterka::regime
