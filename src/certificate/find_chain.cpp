#include "certificate/find_chain.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "certificate/bends.hpp"

namespace peterka::certificate {

std::int64_t EventChain::impacts() const {
    return std::ranges::count(events, EventKind::touch, &Event::kind);
}

namespace {

// The largest h for which value + slope h + bend h^2/2 <= 0, for a value of at most 0.
double safe_step(double value, double slope, double bend) {
    const double root = std::sqrt(std::max(0.0, slope * slope - 2 * bend * value));
    return slope > 0 ? -2 * value / (slope + root) : (root - slope) / bend;
}

// A hammer in motion.
class Walk {
  public:
    Walk(const Springs<double>& springs, const Vector<double>& state)
        : springs_(&springs), state_(state), presses_(state.position > 0 && springs.force(state) > 0) {}

    [[nodiscard]] bool presses() const { return presses_; }
    [[nodiscard]] double time() const { return time_; }

    // Continues until the next event, or until a given time if that comes first. none: neither is reached.
    enum class End { event, time, none };
    [[nodiscard]] End go_on(double until, Event& event) {
        const Phase<double>& phase = springs_->phase(presses_);
        const Leg<double> leg(phase, time_, state_);
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
                stop_at(leg.at(left).state, until);
                return End::time;
            }
            offset += step;
        }
        return End::none;
    }

  private:
    // The largest step that passes no event.
    [[nodiscard]] double largest_step(const Phase<double>& phase, const Moment<double>& now, double cap,
                                      bool begins) const {
        const Vector<double>& state = now.state;
        const Bends bend = bends(phase, now, cap, Within::later);
        if (!presses_ && !begins && state.position <= 0)
            return safe_step(state.position, state.velocity, bend.acceleration);
        const double sign = presses_ ? -1 : 1;
        const double slope = springs_->force({state.velocity, phase.acceleration(state, now.angle.sine)});
        const bool on_surface = begins && !(presses_ && springs_->rig.damping > 0 && touched_);
        const double value = on_surface ? 0 : std::min(0.0, sign * springs_->force(state));
        return safe_step(value, sign * slope, bend.of_force(springs_->rig));
    }

    End meet(double offset, const Moment<double>& now, Event& event) {
        // Where the force rises through 0 beyond the surface, delta' < 0.
        event.kind = presses_                 ? EventKind::release
                     : now.state.velocity < 0 ? EventKind::resume
                                              : EventKind::touch;
        const Vector<double> surface = springs_->surface(event.kind);
        event.along = surface.velocity == 1 ? now.state.velocity : now.state.position;
        stop_at({surface.position * event.along, surface.velocity * event.along}, time_ + offset);
        event.time = time_;
        touched_ = event.kind == EventKind::touch;
        presses_ = event.kind != EventKind::release;
        began_with_event_ = true;
        return End::event;
    }
    void stop_at(const Vector<double>& state, double time) {
        state_ = state;
        time_ = time;
        began_with_event_ = false;
    }

    const Springs<double>* springs_;
    Vector<double> state_;
    double time_ = 0;
    bool presses_;
    bool began_with_event_ = false;
    bool touched_ = false;
};

// From the middle of the leg after the first event to q cycles later, so that no event is near either end.
std::optional<EventChain> events_of(const Springs<double>& springs, const StroboscopicOrbit& orbit) {
    const double period = springs.rig.period;
    const double duration = static_cast<double>(orbit.period) * period;
    EventChain chain{orbit.period, {}};
    Walk walk(springs, {orbit.displacement - springs.rig.gap, orbit.velocity});
    Event event;
    if (walk.go_on(1.5 * duration, event) != Walk::End::event) return std::nullopt;
    const bool presses = event.kind != EventKind::release;
    const double first = event.time;
    if (walk.go_on(first + 1.5 * duration, event) != Walk::End::event) return std::nullopt;
    chain.events.push_back(event);
    const double end = 0.5 * (first + event.time) + duration;
    Walk::End how = walk.go_on(end, event);
    for (; how == Walk::End::event && chain.events.size() < most_events; how = walk.go_on(end, event)) {
        chain.events.push_back(event);
    }
    if (how != Walk::End::time || chain.presses(chain.events.size() - 1) != presses) return std::nullopt;
    for (Event& each : chain.events) {
        each.cycle = static_cast<std::int64_t>(std::floor(each.time / period));
        each.time -= static_cast<double>(each.cycle) * period;
    }
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
        const auto put = [&](Eigen::Index column, const Vector<double>& derivative) {
            equations.derivatives(row, column) = derivative.position;
            equations.derivatives(row + 1, column) = derivative.velocity;
        };
        const auto next = static_cast<Eigen::Index>(2 * chain.next(i));
        equations.residuals[row] = leg.residual.position;
        equations.residuals[row + 1] = leg.residual.velocity;
        put(row, leg.of_time);
        put(row + 1, leg.of_along);
        put(next, leg.of_end_time);
        put(next + 1, leg.of_end_along);
    }
    return equations;
}

std::optional<EventChain> find_chain(const Springs<double>& springs, const StroboscopicOrbit& orbit) {
    std::optional<EventChain> chain = events_of(springs, orbit);
    if (!chain) return std::nullopt;
    for (int steps = 0; steps < 8; ++steps) {
        const EquationsInDoubles equations = equations_in_doubles(springs, *chain);
        if (move(*chain, equations.derivatives.partialPivLu().solve(equations.residuals))) return chain;
    }
    return std::nullopt;
}

}  // namespace peterka::certificate
