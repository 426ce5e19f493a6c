// Orbits with chatter: on a rigid stop with r < 1, bounces follow each other ever faster while the stop
// presses, and end in rest after a finite time (C. Budd and F. Dux, Phil. Trans. R. Soc. A 347, 1994).
//
// At rest on the stop the hammer has the acceleration a(s), s = sin(theta), which rises with s. So each cycle
// has one stretch of pressing, a > 0, at whose end the hammer lifts off from rest: in one state at one phase,
// whatever came before. Its motion from there is followed bounce by bounce to the one after which the lemma
// below proves rest until the next lift-off; q is the number of cycles in between. All neighbours end in the
// same state: both multipliers are 0.
//
// Lemma. The hammer leaves the stop with speed w at a time from which a_min <= a <= a_max for a time T that
// ends before the lift-off. Let V = 2 w, D = w^2/a_min, and let S bound the slope of the cubic term up to
// |u| = |g| + D. While |delta'| <= V and |delta| <= D, delta'' lies between alpha = a_min - c V - S D and
// beta = a_max + c V + (K + S) D. If alpha > 0, a flight takes at most 2 w/alpha, reaches a depth of at most
// w^2/(2 alpha), and ends with a speed of at most w sqrt(beta/alpha). If these bounds are below D and V, and
// kappa = r sqrt(beta/alpha) < 1, then the same holds for the next flight, which begins with kappa w at most,
// and so on: the hammer is at rest after 2 w/(alpha (1 - kappa)). If that is at most T, it rests until it lifts
// off.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "certificate/find_chain.hpp"

namespace peterka::certificate {

// [alpha, beta] of the lemma, from [a_min, a_max], V and D.
[[nodiscard]] Interval acceleration_near_stop(const Phase<Interval>& phase, const Interval& pressing,
                                              const Interval& speed, const Interval& depth);

// Sets springs.lift_off; false if the hammer never lifts off from rest on this stop, or this is not proved.
[[nodiscard]] bool find_lift_off(Springs<Interval>& springs);

// The chain of a claimed orbit that rests on a rigid stop, in doubles; nothing if it does not. Both springs
// have their lift_off.
[[nodiscard]] std::optional<EventChain> find_chatter(const Springs<Interval>& springs,
                                                     const Springs<double>& approximate,
                                                     const StroboscopicOrbit& orbit);

// The lemma for the flight after an impact, `left` [tau] before the lift-off: a bound of the speeds of all
// later impacts, in A0 omega.
[[nodiscard]] std::optional<double> speed_before_rest(const Springs<Interval>& springs,
                                                      const Place<Interval>& impact, const Interval& left);

// Proves that after the last bounce of such a chain the hammer comes to rest and remains there until it lifts
// off. A bound of the speeds of all later impacts, in A0 omega.
[[nodiscard]] std::optional<double> comes_to_rest(const Springs<Interval>& springs, const EventChain& chain,
                                                  const std::vector<Place<Interval>>& places);

// p: the impacts of the last stretch of pressing, which end in rest, count as one. 0 if it cannot be told to
// which stretch one belongs.
[[nodiscard]] std::int64_t impacts_with_chatter(const Springs<Interval>& springs, const EventChain& chain,
                                                const std::vector<Place<Interval>>& places);

}  // namespace peterka::certificate
