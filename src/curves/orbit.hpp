// A periodic orbit as the chain of its events: between two of them the hammer moves along one linear leg, in
// flight or against the stop, whose state at any time has a closed form.
//
// Each event has its time and, except at a grazing, the hammer's velocity; its surface determines the
// penetration. So an orbit of E events has 2E unknowns, and each leg gives two equations: it ends where the
// next event begins. They stay smooth at a grazing, where a stroboscopic map does not (Nordmark 1991, J. Sound
// Vib. 145, 279); what a leg does between its events is checked afterwards (orbit_check.hpp).
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
    resume,   // the force rises through 0 again before the hammer has left: the same impact continues
    graze,    // delta = delta' = 0: an impact is just gained or lost
};

struct Event {
    EventKind kind = EventKind::touch;
    bool presses = false;  // whether the stop presses along the leg that follows
    double time = 0;       // tau
    double velocity = 0;   // delta' in A0 omega, before an impact; 0 where it grazes
};

struct Orbit {
    std::int64_t period = 1;    // q [forcing cycles]
    std::vector<Event> events;  // in their order, over one period

    [[nodiscard]] const Event& after(std::size_t i) const { return events[(i + 1) % events.size()]; }
    // Length of the leg that starts at event i of an orbit of this duration [tau].
    [[nodiscard]] double length_of_leg(std::size_t i, double duration) const {
        return after(i).time - events[i].time + (i + 1 == events.size() ? duration : 0);
    }
    [[nodiscard]] std::int64_t impacts() const {
        return std::ranges::count(events, EventKind::touch, &Event::kind);
    }
    // Index of the grazing event; the number of events if there is none.
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
