#include "curves/motion_events.hpp"

#include <variant>

#include "support/stop_if_asked.hpp"
#include "trajectory/phase_ends.hpp"

namespace peterka::curves {

namespace {

using motion::Leg;
using motion::LinearMotion;
using PhaseEnds = trajectory::PhaseEnds<double>;
using Ending = trajectory::Crossing<double>::Ending;

// The legs and events of trajectory/linear_legs.hpp and rigid_legs.hpp, with the event times recorded.
class Walk {
  public:
    explicit Walk(const PlacedRig& rig)
        : rig_(rig),
          oscillator_(rig.oscillator()),
          flight_(motion::flight_equation(oscillator_)),
          contact_(rig.is_rigid() ? motion::flight_equation(oscillator_)
                                  : motion::contact_equation(oscillator_)),
          phase_ends_({.position = rig.force({1, 0}), .velocity = rig.force({0, 1})}, flight_, contact_) {}

    [[nodiscard]] std::optional<std::vector<Event>> events(State<double> x, std::int64_t cycles) const {
        std::vector<Event> found;
        Phase phase = trajectory::phase_of(oscillator_, x);
        if (rig_.is_rigid() && phase == Phase::contact) return std::nullopt;
        for (std::int64_t cycle = 0; cycle < cycles; ++cycle) {
            const double begin = rig_.duration_of(cycle);
            double time = 0;
            while (true) {
                stop_if_asked();
                const Leg<double> leg(phase == Phase::contact ? contact_ : flight_, x,
                                      oscillator_.frequency * time);
                const double left = oscillator_.period() - time;
                const PhaseEnds::End next = phase_ends_.first_on(phase, leg, left);
                if (next.ending == Ending::none) {
                    x = leg.at(left).state;
                    break;
                }
                if (next.ending != Ending::crossing || found.size() >= most_events) return std::nullopt;
                time += next.moment.time;
                enter(next, begin + time, phase, x, found);
            }
            if (!x.allFinite()) return std::nullopt;
        }
        return found;
    }

    [[nodiscard]] std::optional<Event> first_after(const Event& from, double within) const {
        State<double> x = rig_.departure(from);
        Phase phase = from.presses ? Phase::contact : (x[0] > 0 ? Phase::unloaded : Phase::flight);
        double time = from.time;
        std::vector<Event> met;
        while (met.empty()) {
            const Leg<double> leg(from.presses ? contact_ : flight_, x, oscillator_.frequency * time);
            const PhaseEnds::End next = phase_ends_.first_on(phase, leg, from.time + within - time);
            if (next.ending != Ending::crossing) return std::nullopt;
            time += next.moment.time;
            enter(next, time, phase, x, met);
        }
        return met.front();
    }

  private:
    void enter(const PhaseEnds::End& next, double time, Phase& phase, State<double>& x,
               std::vector<Event>& found) const {
        const Phase before = phase;
        phase = next.next;
        x = next.moment.state;
        if (next.next == Phase::flight) {  // it leaves the stop, which has released it before
            x[0] = 0;
            return;
        }
        const bool presses = next.next == Phase::contact;
        EventKind kind = EventKind::release;
        if (presses) kind = before == Phase::unloaded && x[1] < 0 ? EventKind::resume : EventKind::touch;
        found.push_back({kind, presses && !rig_.is_rigid(), time, x[1]});
        x = rig_.departure(found.back());
        if (rig_.is_rigid()) phase = Phase::flight;
    }

    const PlacedRig& rig_;
    const scene::Oscillator<double>& oscillator_;
    LinearMotion<double> flight_;
    LinearMotion<double> contact_;
    PhaseEnds phase_ends_;
};

}  // namespace

std::optional<Orbit> orbit_from(const Rig& rig, const PlanePoint& place, const State<double>& start,
                                std::int64_t period) {
    auto events = Walk(rig.at(place)).events(start, period);
    if (!events || events->empty()) return std::nullopt;
    return Orbit{period, std::move(*events)};
}

std::optional<Event> first_event_after(const PlacedRig& rig, const Event& from, double within) {
    return Walk(rig).first_after(from, within);
}

}  // namespace peterka::curves
