#include "certificate/find_chain.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "certificate/bends.hpp"
#include "certificate/safe_step.hpp"

namespace peterka::certificate {

std::int64_t EventChain::impacts() const {
    return std::ranges::count_if(
        events, [](EventKind kind) { return kind == EventKind::touch || kind == EventKind::bounce; },
        &Event::kind);
}

Walk Walk::after(const Springs<double>& springs, const Event& event) {
    Walk walk(springs, event.time, {0, 0});
    walk.leave(event);
    return walk;
}

void Walk::leave(const Event& event) {
    state_ = scaled(springs_->leaving(event.kind), event.along);
    time_ = event.time;
    touched_ = event.kind == EventKind::touch || event.kind == EventKind::bounce;
    presses_ = presses_after(event.kind);
    began_with_event_ = true;
}

Walk::End Walk::go_on(double until, Event& event) {
    const Phase<double>& phase = springs_->phase(presses_);
    const Leg<double> leg(phase, time_, state_);
    const bool rests = springs_->rig.rigid && touched_ && began_with_event_ && state_.velocity == 0 &&
                       phase.acceleration(state_, leg.start().angle.sine) > 0;
    if (rests) return End::none;
    const double cap = short_time(phase);
    double offset = 0;
    bool begins = began_with_event_;
    for (int steps = 0; steps < 100'000; ++steps) {
        const Moment<double> now = leg.at(offset);
        const double left = until - time_ - offset;
        const double step = std::min(cap, largest_step(phase, now, cap, begins));
        if (!begins && step < 1e-13 * (1 + offset)) return meet(offset, now, event);
        begins = false;
        if (step >= left) {
            stop_at(leg.at(offset + left).state, until);
            return End::time;
        }
        offset += step;
    }
    return End::none;
}

double Walk::largest_step(const Phase<double>& phase, const Moment<double>& now, double cap,
                          bool begins) const {
    const Vector<double>& state = now.state;
    const Bends bend = bends(phase, now, cap, Within::later);
    if (springs_->rig.rigid) {
        if (begins && state.velocity == 0) {  // from rest; at a lift-off the acceleration is 0, too
            const double by_acceleration = -phase.acceleration(state, now.angle.sine) / bend.jerk;
            return std::max({0.0, by_acceleration, -phase.jerk(state, 0, now.angle) / bend.snap});
        }
        return safe_step(begins ? 0 : std::min(0.0, state.position), state.velocity, bend.acceleration);
    }
    if (!presses_ && !begins) {
        if (state.position <= 0) return safe_step(state.position, state.velocity, bend.acceleration);
        if (state.velocity > 0) return 0;  // it has touched, by rounding just above the surface
    }
    const double sign = presses_ ? -1 : 1;
    const double slope = springs_->force({state.velocity, phase.acceleration(state, now.angle.sine)});
    const bool on_surface = begins && !(presses_ && springs_->rig.damping > 0 && touched_);
    const double value = on_surface ? 0 : std::min(0.0, sign * springs_->force(state));
    return safe_step(value, sign * slope, bend.of_force(springs_->rig));
}

Walk::End Walk::meet(double offset, const Moment<double>& now, Event& event) {
    // Where the force rises through 0 beyond the surface, delta' < 0.
    event.kind = springs_->rig.rigid      ? EventKind::bounce
                 : presses_               ? EventKind::release
                 : now.state.velocity < 0 ? EventKind::resume
                                          : EventKind::touch;
    event.along = springs_->along(event.kind, now.state);
    event.time = time_ + offset;
    leave(event);
    return End::event;
}

void Walk::stop_at(const Vector<double>& state, double time) {
    state_ = state;
    time_ = time;
    began_with_event_ = false;
}

void sort_into_cycle(Event& event, double period) {
    event.cycle = static_cast<std::int64_t>(std::floor(event.time / period));
    event.time -= static_cast<double>(event.cycle) * period;
}

namespace {

// From the middle of the leg after the first event to q cycles later, so that no event is near either end.
std::optional<EventChain> events_of(const Springs<double>& springs, const StroboscopicOrbit& orbit) {
    const double period = springs.rig.period;
    const double duration = static_cast<double>(orbit.period) * period;
    EventChain chain{orbit.period, {}};
    Walk walk(springs, 0, {orbit.displacement - springs.rig.gap, orbit.velocity});
    Event event;
    if (walk.go_on(1.5 * duration, event) != Walk::End::event) return std::nullopt;
    const bool presses = presses_after(event.kind);
    const double first = event.time;
    if (walk.go_on(first + 1.5 * duration, event) != Walk::End::event) return std::nullopt;
    chain.events.push_back(event);
    const double end = 0.5 * (first + event.time) + duration;
    Walk::End how = walk.go_on(end, event);
    for (; how == Walk::End::event && chain.events.size() < most_events; how = walk.go_on(end, event)) {
        chain.events.push_back(event);
    }
    if (how != Walk::End::time || chain.presses(chain.events.size() - 1) != presses) return std::nullopt;
    for (Event& each : chain.events) sort_into_cycle(each, period);
    return chain;
}

bool move(EventChain& chain, const Eigen::VectorXd& step) {
    double largest = 0;
    for (std::size_t i = 0; i < chain.events.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(2 * i);
        chain.events[i].time -= step[row];
        chain.events[i].along -= step[row + 1];
        largest = std::max(largest, std::abs(step[row]));
    }
    return largest < 1e-12;
}

}  // namespace

std::vector<Place<double>> places_of(const EventChain& chain) {
    std::vector<Place<double>> places;
    for (const Event& event : chain.events) places.push_back({event.time, event.along});
    return places;
}

EquationsInDoubles equations_in_doubles(const Springs<double>& springs, const EventChain& chain) {
    const auto size = static_cast<Eigen::Index>(2 * chain.events.size());
    EquationsInDoubles equations{Eigen::VectorXd(size), Eigen::MatrixXd::Zero(size, size)};
    const std::vector<Place<double>> places = places_of(chain);
    for (std::size_t i = 0; i < chain.events.size(); ++i) {
        const LegEquations<double> leg = leg_equations(springs, chain, places, i);
        const auto row = static_cast<Eigen::Index>(2 * i);
        // Of an orbit with a single event, a bounce, the leg begins and ends at the same one.
        const auto add = [&](Eigen::Index column, const Vector<double>& derivative) {
            equations.derivatives(row, column) += derivative.position;
            equations.derivatives(row + 1, column) += derivative.velocity;
        };
        const auto next = static_cast<Eigen::Index>(2 * chain.next(i));
        equations.residuals[row] = leg.residual.position;
        equations.residuals[row + 1] = leg.residual.velocity;
        add(row, leg.of_time);
        add(row + 1, leg.of_along);
        add(next, leg.of_end_time);
        add(next + 1, leg.of_end_along);
    }
    return equations;
}

bool refine(const Springs<double>& springs, EventChain& chain) {
    for (int steps = 0; steps < 8; ++steps) {
        const EquationsInDoubles equations = equations_in_doubles(springs, chain);
        if (move(chain, equations.derivatives.partialPivLu().solve(equations.residuals))) return true;
    }
    return false;
}

std::optional<EventChain> find_chain(const Springs<double>& springs, const StroboscopicOrbit& orbit) {
    std::optional<EventChain> chain = events_of(springs, orbit);
    if (!chain || !refine(springs, *chain)) return std::nullopt;
    return chain;
}

}  // namespace peterka::certificate
