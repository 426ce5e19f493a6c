// Proof that a leg meets no event except those at its ends.
//
// Lemma. In flight the stop does not press as long as at each moment delta < 0 or kappa delta + chi delta' < 0;
// in contact it presses as long as kappa delta + chi delta' > 0 (from a contact with delta > 0, delta can reach
// 0 only with delta' <= 0, where this fails). A rigid stop is not met as long as delta < 0. At an end, the
// signal that makes the event is 0, and its slope tells from which side it comes. In between, steps are proved
// one after the other by S(t + h) <= S + S' h + C h^2/2 with a bound C of |S''| (bends.hpp).
//
// A grazing is taken to have along = 0, whatever its enclosure: the proof is about motions that graze. There,
// at rest on the surface, delta < 0 before and after if delta'' < 0; where the stop presses again instead, the
// force rises through 0 as at any renewed contact.
#pragma once

#include <optional>

#include "certificate/signal.hpp"

namespace peterka::certificate {

// Proves for leg i of a chain, whose events lie in `places`, that it is free of events and that its end crosses
// the surface transversally.
[[nodiscard]] bool leg_is_free(const Springs<Interval>& springs, const EventChain& chain,
                               const std::vector<Place<Interval>>& places, std::size_t i);
// The same for a leg that begins with an event or, if there is none, at the start of a motion.
[[nodiscard]] bool leg_is_free(const Springs<Interval>& springs, const Leg<Interval>& leg,
                               const Interval& length, bool presses, std::optional<EventKind> from,
                               EventKind to, const Place<Interval>& end);

// Marches along a leg from an offset, in steps as long as can be proved to keep one of the signals below 0.
class March {
  public:
    March(const Springs<Interval>& springs, const Leg<Interval>& leg, bool presses)
        : springs_(&springs), leg_(&leg), presses_(presses), cap_(short_time(leg.phase())) {}

    // The first step, after an event or from the start of a motion.
    [[nodiscard]] bool begin(std::optional<EventKind> from, double until);
    // One step from the offset, at most up to `until`; on_surface: the signal is 0 there. False: no step can be
    // proved.
    [[nodiscard]] bool step(double until, bool on_surface = false);
    [[nodiscard]] double offset() const { return offset_; }

  private:
    // The first step from rest on the surface, where the first derivative of delta that is not 0 is negative:
    // the second, after an impact with r = 0 or at a grazing, or the third, at a lift-off. Then delta stays
    // negative for 3, or 4, times its size over a bound of the next derivative.
    [[nodiscard]] bool leave_at_once(double until);
    [[nodiscard]] bool lift_off(double until);

    const Springs<Interval>* springs_;
    const Leg<Interval>* leg_;
    bool presses_;
    double cap_;
    double offset_ = 0;
};

}  // namespace peterka::certificate
