// A periodic orbit with contacts as a chain of events, and the equations that it satisfies.
//
// An event lies on a line through (0, 0) of the plane (delta, delta') along a direction d: a touch and a bounce
// on delta = 0, d = (0, 1); a release and a resumed contact on kappa delta + chi delta' = 0. So its unknowns
// are its time and its coordinate along d. The leg between two events, in closed form, contributes two
// equations: it ends where the next event begins. A bounce of a rigid stop lets the next leg begin along (0,
// -r) instead. After chatter the hammer rests on a rigid stop until it lifts off, along = 0, at a phase known
// beforehand: the first event of such a chain, whose equations are just that (chatter.hpp). The two kinds of
// grazing are turning points, delta' = 0, d = (1, 0), at which delta need not be 0: the equations of a chain
// with one continue smoothly past a grazing, and describe a motion where along = 0 (branch_crossing.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "certificate/leg.hpp"

namespace peterka::certificate {

enum class EventKind : std::int8_t {
    touch,            // delta rises through 0: an impact
    release,          // the stop's force falls through 0
    resume,           // the force rises through 0 again before the hammer has left
    bounce,           // delta rises through 0, and a rigid stop reverses the velocity: an impact
    lift_off,         // the acceleration that presses the hammer at rest against a rigid stop falls through 0
    graze,            // a flight's largest delta: it just reaches the stop
    resume_at_graze,  // a flight's smallest delta beyond the surface, from which on the stop presses again: the
                      // hammer just fails to leave it
};

constexpr bool is_grazing(EventKind kind) {
    return kind == EventKind::graze || kind == EventKind::resume_at_graze;
}

// Whether the stop presses after an event.
constexpr bool presses_after(EventKind kind) {
    return kind == EventKind::touch || kind == EventKind::resume || kind == EventKind::resume_at_graze;
}

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
    [[nodiscard]] bool presses(std::size_t i) const { return presses_after(events[i].kind); }
    // Whole cycles between the cycles of an event and of the next one.
    [[nodiscard]] std::int64_t cycles_of_leg(std::size_t i) const {
        return events[next(i)].cycle - events[i].cycle + (next(i) == 0 ? period : 0);
    }
    [[nodiscard]] std::int64_t impacts() const;  // of a chain without chatter
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
        if (rig.rigid) return;
        const bool spring = size_of(rig.stiffness) >= size_of(rig.damping);
        release = spring ? Vector<Number>{-(rig.damping / rig.stiffness), Number(1)}
                         : Vector<Number>{Number(1), -(rig.stiffness / rig.damping)};
    }
    [[nodiscard]] const Phase<Number>& phase(bool presses) const { return presses ? contact : flight; }
    [[nodiscard]] Vector<Number> surface(EventKind kind) const {
        if (is_grazing(kind)) return {Number(1), Number(0)};
        const bool without_force = kind == EventKind::release || kind == EventKind::resume;
        return without_force ? release : Vector<Number>{Number(0), Number(1)};
    }
    // The coordinate along d of a state on the surface, in doubles.
    [[nodiscard]] Number along(EventKind kind, const Vector<Number>& state) const {
        return surface(kind).velocity == 1 ? state.velocity : state.position;
    }
    // The direction along which the leg after an event begins.
    [[nodiscard]] Vector<Number> leaving(EventKind kind) const {
        return kind == EventKind::bounce ? Vector<Number>{Number(0), -rig.restitution} : surface(kind);
    }
    [[nodiscard]] Number force(const Vector<Number>& state) const {
        return rig.stiffness * state.position + rig.damping * state.velocity;
    }

    RigOf<Number> rig;
    Phase<Number> flight;
    Phase<Number> contact;
    Vector<Number> release;  // d; none of a rigid stop
    Number lift_off = 0;     // when in the cycle a hammer at rest leaves a rigid stop [tau] (find_lift_off)
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
                        scaled(springs.leaving(chain.events[i].kind), from.along)),
            places[chain.next(i)].time - from.time + Number(cycles) * springs.rig.period};
}

// The equations of a rest on a rigid stop: it ends with the lift-off, whatever led to it.
template <class Number>
Vector<Number> lift_off_residual(const Springs<Number>& springs, const Place<Number>& place) {
    return {place.time - springs.lift_off, place.along};
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

// Of a leg from leaving * along to an event of a given kind.
template <class Number>
LegEquations<Number> leg_equations(const Springs<Number>& springs, const Leg<Number>& leg, const Number& length,
                                   const Vector<Number>& leaving, EventKind to, const Place<Number>& end) {
    const Vector<Number> surface = springs.surface(to);
    const auto rates = [&](const Moment<Number>& moment) {
        return Vector<Number>{moment.state.velocity, leg.phase().acceleration(moment.state, moment.angle.sine)};
    };
    LegEquations<Number> equations;
    equations.flow = leg.flow(length);
    const Moment<Number> met = leg.end(length, equations.flow, end.time);
    equations.residual = met.state - scaled(surface, end.along);
    equations.of_time = scaled(equations.flow * rates(leg.start()), Number(-1));
    equations.of_along = equations.flow * leaving;
    equations.of_end_time = rates(met);
    equations.of_end_along = scaled(surface, Number(-1));
    return equations;
}

template <class Number>
LegEquations<Number> leg_equations(const Springs<Number>& springs, const EventChain& chain,
                                   const std::vector<Place<Number>>& places, std::size_t i) {
    const std::size_t next = chain.next(i);
    if (chain.events[next].kind == EventKind::lift_off) {
        LegEquations<Number> rest;
        rest.residual = lift_off_residual(springs, places[next]);
        rest.of_end_time.position = 1;
        rest.of_end_along.velocity = 1;
        return rest;
    }
    const auto [leg, length] = leg_of(springs, chain, places, i);
    return leg_equations(springs, leg, length, springs.leaving(chain.events[i].kind), chain.events[next].kind,
                         places[next]);
}

// The residual alone.
template <class Number>
Vector<Number> leg_residual(const Springs<Number>& springs, const EventChain& chain,
                            const std::vector<Place<Number>>& places, std::size_t i) {
    const std::size_t next = chain.next(i);
    if (chain.events[next].kind == EventKind::lift_off) return lift_off_residual(springs, places[next]);
    const auto [leg, length] = leg_of(springs, chain, places, i);
    return leg.end(length, places[next].time).state - end_of_leg(springs, chain, places, i);
}

}  // namespace peterka::certificate
