// The end of a stretch of linear motion in one phase of a stop (linear_legs.hpp): the signals whose zeros end
// the phases, and which of them a leg meets first.
#pragma once

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "trajectory/first_crossing.hpp"
#include "trajectory/journey.hpp"

namespace peterka::trajectory {

template <class Real>
class PhaseEnds {
  public:
    // force: that of the stop while it presses, by (delta, delta').
    PhaseEnds(const motion::Signal<Real>& force, const motion::LinearMotion<Real>& flight,
              const motion::LinearMotion<Real>& contact)
        : touch_({.position = 1}, flight),
          leave_({.position = -1}, flight),
          resume_(force, flight),
          release_(-force, contact) {}

    struct End {
        typename Crossing<Real>::Ending ending;
        Phase next;
        motion::Moment<Real> moment;
    };
    // In tau from the leg's start; the moment counts only if the ending is a crossing.
    [[nodiscard]] End first_on(Phase phase, const motion::Leg<Real>& leg, Real end) const {
        using Ending = typename Crossing<Real>::Ending;
        if (phase == Phase::unloaded) {
            const auto out = first_crossing(leg, leave_, leg.start(), end);
            const bool leaves = out.ending == Ending::crossing;
            const auto back = first_crossing(leg, resume_, leg.start(), leaves ? out.moment.time : end);
            if (back.ending != Ending::none) return {back.ending, Phase::contact, back.moment};
            return {out.ending, Phase::flight, out.moment};
        }
        const auto found = first_crossing(leg, phase == Phase::flight ? touch_ : release_, leg.start(), end);
        return {found.ending, phase == Phase::flight ? Phase::contact : Phase::unloaded, found.moment};
    }

    [[nodiscard]] const motion::Probe<Real>& touch() const { return touch_; }

  private:
    motion::Probe<Real> touch_;    // delta rises through 0
    motion::Probe<Real> leave_;    // and falls
    motion::Probe<Real> resume_;   // the force would rise through 0
    motion::Probe<Real> release_;  // and falls
};

}  // namespace peterka::trajectory
