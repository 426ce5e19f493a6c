// The way of a motion from its exact start, event by event, to where it surely ends.
#pragma once

#include "certificate/chatter.hpp"
#include "certificate/fine_patch.hpp"
#include "certificate/steady_motion.hpp"
#include "certificate/trap.hpp"

namespace peterka::certificate {

// The motion from a state (delta, delta') at time 0, proved up to an event. Against a rigid stop whose lift_off
// is known, chatter that ends in rest counts as one event, the lift-off (chatter.hpp).
class StartWay {
  public:
    StartWay(const Springs<Interval>& springs, const Springs<double>& approximate,
             const Vector<Interval>& start);
    // In many digits (fine_patch.hpp).
    StartWay(const SpringsOf& springs, const Vector<Ball>& start);

    enum class Step {
        proved,   // up to the next event
        lost,     // the next event is not proved
        no_event  // none is met in the next 60 cycles, in doubles
    };
    // Times of events are counted so that they lie within half a cycle from `near` [tau].
    [[nodiscard]] Step go_on(double near);

    [[nodiscard]] const std::optional<Patch>& at() const { return at_; }  // none at the start
    // From the start to that event, in doubles [forcing cycles].
    [[nodiscard]] double cycles() const;
    // The motion after that event at the next forcing phase 0, (delta, delta'), in doubles.
    [[nodiscard]] Vector<double> at_phase_0() const;
    // The motion from there on, in this phase.
    [[nodiscard]] Leg<Interval> leg(bool presses) const;

  private:
    [[nodiscard]] std::optional<Patch> next_at(const Event& next);
    void rest_if_proved();

    const Springs<Interval>* springs_;
    const Springs<double>* approximate_;
    Vector<Interval> start_;
    bool presses_;
    std::optional<Patch> at_;
    std::int64_t cycle_ = 0;  // of at_, counted from the start
    const Springs<Ball>* fine_springs_ = nullptr;
    Vector<Ball> fine_start_;
    std::optional<FinePatch> fine_;  // within at_
};

// Whether the motion from a state at time 0 is proved to end in a trap; at rest on a rigid stop, from where all
// motions follow the same way; or on a steady motion.
enum class Leads {
    there,
    elsewhere,  // in doubles: the way has been followed to where it hardly changes any more, and is not there
    unknown
};
[[nodiscard]] Leads leads_to_orbit(StartWay& way, const Trap& trap);
[[nodiscard]] Leads leads_to_rest(StartWay& way);
[[nodiscard]] Leads leads_to_steady(const Springs<Interval>& springs, StartWay& way, bool presses,
                                    const SteadyMotion& motion);

}  // namespace peterka::certificate
