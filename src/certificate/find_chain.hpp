// The chain of events of an orbit, in doubles, from its state at forcing phase 0: the starting point of a
// proof, which trusts none of it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct StroboscopicOrbit {
    std::int64_t impacts = 0;  // p
    std::int64_t period = 0;   // q
    double displacement = 0;   // (x - y)/A0 at forcing phase 0
    double velocity = 0;       // (x' - y')/(A0 omega) there
};

inline constexpr std::size_t most_events = 400;

// nothing: no chain from this state closes after q cycles.
[[nodiscard]] std::optional<EventChain> find_chain(const Springs<double>& springs,
                                                   const StroboscopicOrbit& orbit);

// The hammer in motion, in doubles, from a state (delta, delta') at a time.
class Walk {
  public:
    Walk(const Springs<double>& springs, double time, const Vector<double>& state)
        : springs_(&springs),
          state_(state),
          time_(time),
          presses_(state.position > 0 && springs.force(state) > 0) {}
    static Walk after(const Springs<double>& springs, const Event& event);

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const Vector<double>& state() const { return state_; }

    // Continues until the next event, or until a given time if that comes first. none: neither is reached, or
    // the hammer rests, as it does where a rigid stop with r = 0 presses it after an impact.
    enum class End { event, time, none };
    [[nodiscard]] End go_on(double until, Event& event);

  private:
    // The largest step that passes no event.
    [[nodiscard]] double largest_step(const Phase<double>& phase, const Moment<double>& now, double cap,
                                      bool begins) const;
    End meet(double offset, const Moment<double>& now, Event& event);
    void leave(const Event& event);
    void stop_at(const Vector<double>& state, double time);

    const Springs<double>* springs_;
    Vector<double> state_;
    double time_;
    bool presses_;
    bool began_with_event_ = false;
    bool touched_ = false;
};

// For an event whose time is counted from the beginning: its cycle, and the time within it.
void sort_into_cycle(Event& event, double period);

// Newton's method on the equations of a chain: false if it does not converge.
[[nodiscard]] bool refine(const Springs<double>& springs, EventChain& chain);

// The unknowns of a chain in their order: 2 i the time of event i, 2 i + 1 its coordinate.
[[nodiscard]] inline double& unknown_of(EventChain& chain, std::size_t number) {
    Event& event = chain.events[number / 2];
    return number % 2 == 0 ? event.time : event.along;
}

[[nodiscard]] std::vector<Place<double>> places_of(const EventChain& chain);

// The legs' equations in order, two rows each; columns are (time, along) of the events.
struct EquationsInDoubles {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd derivatives;
};
[[nodiscard]] EquationsInDoubles equations_in_doubles(const Springs<double>& springs, const EventChain& chain);

}  // namespace peterka::certificate
