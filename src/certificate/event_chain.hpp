// A periodic orbit with contacts as the chain of its events, and the equations that it obeys.
//
// An event lies on a surface, through (0, 0) of the plane (delta, delta') along a direction d: a touch on delta
// = 0, d = (0, 1); a release and a resumed contact on kappa delta + chi delta' = 0. So its unknowns are its
// time and how far along d it lies. The leg between two events, in closed form, brings two equations: that it
// ends where the next event begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "certificate/phase.hpp"

namespace peterka::certificate {

enum class EventKind : std::int8_t {
    touch,    // delta rises through 0: an impact
    release,  // the stop's force falls through 0
    resume,   // it rises through 0 again before the hammer has left
};

struct Event {
    EventKind kind = EventKind::touch;
    std::int64_t cycle = 0;  // in which it happens
    double time = 0;         // within the cycle [tau]
    double along = 0;        // of d
};

struct EventChain {
    std::int64_t period = 1;  // q [forcing cycles]
    std::vector<Event> events;

    [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % events.size(); }
    [[nodiscard]] bool presses(std::size_t i) const { return events[i].kind != EventKind::release; }
    // Whole cycles between the cycles of an event and the next.
    [[nodiscard]] std::int64_t cycles_of_leg(std::size_t i) const {
        return events[next(i)].cycle - events[i].cycle + (next(i) == 0 ? period : 0);
    }
    [[nodiscard]] std::int64_t impacts() const;
};

// Where an event is: its unknowns as numbers, or as what is proved to hold them.
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

// One leg of a chain, with what its end depends on.
template <class Number>
struct LegEquations {
    Leg<Number> leg;
    Number length;  // [tau]
    Matrix<Number> flow;
    Moment<Number> end;
    Vector<Number> residual;  // of the end from the next event
    Vector<Number> of_time;   // derivatives of the residual by this event's unknowns
    Vector<Number> of_along;
    Vector<Number> of_end_time;  // and by the next event's
    Vector<Number> of_end_along;
};

template <class Number>
LegEquations<Number> leg_equations(const Springs<Number>& springs, const EventChain& chain,
                                   const std::vector<Place<Number>>& places, std::size_t i) {
    const Phase<Number>& phase = springs.phase(chain.presses(i));
    const Place<Number>& from = places[i];
    const Place<Number>& to = places[chain.next(i)];
    const Vector<Number> here = springs.surface(chain.events[i].kind);
    const Vector<Number> there = springs.surface(chain.events[chain.next(i)].kind);
    const auto scaled = [](const Vector<Number>& v, const Number& factor) {
        return Vector<Number>{v.position * factor, v.velocity * factor};
    };
    const auto rates = [&](const Moment<Number>& moment) {
        return Vector<Number>{moment.state.velocity, phase.acceleration(moment.state, moment.angle.sine)};
    };
    LegEquations<Number> equations{
        Leg<Number>(phase, from.time, scaled(here, from.along)),
        to.time - from.time + Number(static_cast<double>(chain.cycles_of_leg(i))) * springs.rig.period,
        {},
        {},
        {},
        {},
        {},
        {},
        {}};
    equations.flow = phase.flow(equations.length);
    equations.end = equations.leg.at(equations.flow, to.time);
    equations.residual = equations.end.state - scaled(there, to.along);
    equations.of_time = scaled(equations.flow * rates(equations.leg.start()), Number(-1));
    equations.of_along = equations.flow * here;
    equations.of_end_time = rates(equations.end);
    equations.of_end_along = scaled(there, Number(-1));
    return equations;
}

}  // namespace peterka::certificate
