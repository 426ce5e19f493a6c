// A periodic orbit with contacts as a chain of events, and the equations that it satisfies.
//
// An event lies on a line through (0, 0) of the plane (delta, delta') along a direction d: a touch on delta =
// 0, d = (0, 1); a release and a resumed contact on kappa delta + chi delta' = 0. So its unknowns are its time
// and its coordinate along d. The leg between two events, in closed form, contributes two equations: it ends
// where the next event begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "certificate/leg.hpp"

namespace peterka::certificate {

enum class EventKind : std::int8_t {
    touch,    // delta rises through 0: an impact
    release,  // the stop's force falls through 0
    resume,   // the force rises through 0 again before the hammer has left
};

struct Event {
    EventKind kind = EventKind::touch;
    std::int64_t cycle = 0;  // in which the event occurs
    double time = 0;         // within the cycle [tau]
    double along = 0;        // coordinate along d
};

struct EventChain {
    std::int64_t period = 1;  // q [forcing cycles]
    std::vector<Event> events;

    [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % events.size(); }
    [[nodiscard]] bool presses(std::size_t i) const { return events[i].kind != EventKind::release; }
    // Whole cycles between the cycles of an event and of the next one.
    [[nodiscard]] std::int64_t cycles_of_leg(std::size_t i) const {
        return events[next(i)].cycle - events[i].cycle + (next(i) == 0 ? period : 0);
    }
    [[nodiscard]] std::int64_t impacts() const;
};

// The unknowns of an event, as numbers or as proved enclosures.
template <class Number>
struct Place {
    Number time = 0;
    Number along = 0;
};

template <class Number>
struct Springs {
    explicit Springs(const RigOf<Number>& numbers)
        : rig(numbers), flight(numbers, false), contact(numbers, true) {
        const bool spring = size_of(rig.stiffness) >= size_of(rig.damping);
        release = spring ? Vector<Number>{-(rig.damping / rig.stiffness), Number(1)}
                         : Vector<Number>{Number(1), -(rig.stiffness / rig.damping)};
    }
    [[nodiscard]] const Phase<Number>& phase(bool presses) const { return presses ? contact : flight; }
    [[nodiscard]] Vector<Number> surface(EventKind kind) const {
        return kind == EventKind::touch ? Vector<Number>{Number(0), Number(1)} : release;
    }
    [[nodiscard]] Number force(const Vector<Number>& state) const {
        return rig.stiffness * state.position + rig.damping * state.velocity;
    }

    RigOf<Number> rig;
    Phase<Number> flight;
    Phase<Number> contact;
    Vector<Number> release;  // d
};

// Leg i of a chain, from one event to the next.
template <class Number>
struct ChainLeg {
    Leg<Number> leg;
    Number length;  // [tau]
};

template <class Number>
Vector<Number> scaled(const Vector<Number>& v, const Number& factor) {
    return {v.position * factor, v.velocity * factor};
}

// The state at the event that ends leg i.
template <class Number>
Vector<Number> end_of_leg(const Springs<Number>& springs, const EventChain& chain,
                          const std::vector<Place<Number>>& places, std::size_t i) {
    const std::size_t next = chain.next(i);
    return scaled(springs.surface(chain.events[next].kind), places[next].along);
}

template <class Number>
ChainLeg<Number> leg_of(const Springs<Number>& springs, const EventChain& chain,
                        const std::vector<Place<Number>>& places, std::size_t i) {
    const Place<Number>& from = places[i];
    const auto cycles = static_cast<double>(chain.cycles_of_leg(i));
    return {Leg<Number>(springs.phase(chain.presses(i)), from.time,
                        scaled(springs.surface(chain.events[i].kind), from.along)),
            places[chain.next(i)].time - from.time + Number(cycles) * springs.rig.period};
}

// A leg's equations, and their derivatives.
template <class Number>
struct LegEquations {
    Matrix<Number> flow;
    Vector<Number> residual;  // of the leg's end with respect to the next event
    Vector<Number> of_time;   // derivatives of the residual by this event's unknowns
    Vector<Number> of_along;
    Vector<Number> of_end_time;  // and by the next event's unknowns
    Vector<Number> of_end_along;
};

template <class Number>
LegEquations<Number> leg_equations(const Springs<Number>& springs, const EventChain& chain,
                                   const std::vector<Place<Number>>& places, std::size_t i) {
    const Phase<Number>& phase = springs.phase(chain.presses(i));
    const auto [leg, length] = leg_of(springs, chain, places, i);
    const std::size_t next = chain.next(i);
    const auto rates = [&](const Moment<Number>& moment) {
        return Vector<Number>{moment.state.velocity, phase.acceleration(moment.state, moment.angle.sine)};
    };
    LegEquations<Number> equations;
    equations.flow = leg.flow(length);
    const Moment<Number> end = leg.end(length, equations.flow, places[next].time);
    equations.residual = end.state - end_of_leg(springs, chain, places, i);
    equations.of_time = scaled(equations.flow * rates(leg.start()), Number(-1));
    equations.of_along = equations.flow * springs.surface(chain.events[i].kind);
    equations.of_end_time = rates(end);
    equations.of_end_along = scaled(springs.surface(chain.events[next].kind), Number(-1));
    return equations;
}

// The residual alone.
template <class Number>
Vector<Number> leg_residual(const Springs<Number>& springs, const EventChain& chain,
                            const std::vector<Place<Number>>& places, std::size_t i) {
    const auto [leg, length] = leg_of(springs, chain, places, i);
    return leg.end(length, places[chain.next(i)].time).state - end_of_leg(springs, chain, places, i);
}

}  // namespace peterka::certificate
