// A periodic orbit as the chain of its events: between two of them the hammer moves along one linear leg, in
// flight or against the stop, whose end the closed form gives at any time.
//
// Each event has its time and, but for a grazing, the hammer's velocity; its surface tells the penetration. So
// an orbit of E events has 2E unknowns, and each leg brings two equations: that it ends where the next event
// begins. They stay smooth where a stroboscopic map does not: what a leg does in between is looked at
// afterwards (orbit_check.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::curves {

using scene::Jacobian;
using scene::State;
using trajectory::Phase;

enum class EventKind : std::int8_t {
    touch,    // delta rises through 0: an impact
    release,  // the stop's force falls through 0
    resume,   // it rises through 0 again before the hammer has left: the same impact goes on
    graze,    // delta and delta' are 0: an impact that is just gained or lost
};

struct Event {
    EventKind kind = EventKind::touch;
    bool presses = false;  // the stop does, along the leg that follows
    double time = 0;       // tau
    double velocity = 0;   // delta' in A0 omega, before an impact; 0 where it grazes
};

struct Orbit {
    std::int64_t period = 1;    // q [forcing cycles]
    std::vector<Event> events;  // in their order, over one period

    [[nodiscard]] const Event& after(std::size_t i) const { return events[(i + 1) % events.size()]; }
    // Of the leg that begins with an event, where the orbit lasts so long [tau].
    [[nodiscard]] double length_of_leg(std::size_t i, double duration) const {
        return after(i).time - events[i].time + (i + 1 == events.size() ? duration : 0);
    }
    [[nodiscard]] std::int64_t impacts() const {
        return std::ranges::count(events, EventKind::touch, &Event::kind);
    }
    // The one that grazes; as many as there are events where none does.
    [[nodiscard]] std::size_t grazing() const {
        return static_cast<std::size_t>(std::ranges::find(events, EventKind::graze, &Event::kind) -
                                        events.begin());
    }
    [[nodiscard]] double largest_speed() const {
        double largest = 0;
        for (const Event& event : events) largest = std::max(largest, std::abs(event.velocity));
        return largest;
    }
};

}  // namespace peterka::curves
