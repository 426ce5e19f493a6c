// An observer of several consecutive cycles: times count from the beginning of the trace, not of each cycle.
#pragma once

#include "trajectory/observer.hpp"

namespace peterka::trace {

using scene::State;
using trajectory::Phase;

// A smooth stretch of motion within one forcing cycle.
struct Stretch {
    Phase phase;
    double begin;        // tau since the trace began
    double cycle_begin;  // the same of its cycle, where the forcing's phase is 0
    double from;         // tau since its cycle began
    double length;
    const trajectory::Observer<double>::StateAt& state_at;  // at a time since the stretch began

    [[nodiscard]] double end() const { return cycle_begin + (from + length); }
};

class Watcher : public trajectory::Observer<double> {
  public:
    void begin_cycle(double at) { cycle_begin_ = at; }
    void stretch(Phase phase, double from, double length, const StateAt& state_at) final {
        const Stretch seen{phase, cycle_begin_ + from, cycle_begin_, from, length, state_at};
        look(seen);
        now_ = seen.end();
    }
    void touch(double /*speed*/) override {}
    void rest(std::int64_t /*impacts*/) override {}
    void leave(const trajectory::ImpactRecord<double>& /*impact*/) override {}
    // Called at the end of the last cycle.
    virtual void finish(const State<double>& /*end*/, Phase /*phase*/) {}

  protected:
    virtual void look(const Stretch& /*stretch*/) {}
    [[nodiscard]] double now() const { return now_; }  // the end of the last stretch
    [[nodiscard]] double cycle_begin() const { return cycle_begin_; }

  private:
    double cycle_begin_ = 0;
    double now_ = 0;
};

}  // namespace peterka::trace
