// A close view of one impact: the motion at evenly spaced times around its first touch, and the instant of its
// largest force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trace/quantities.hpp"

namespace peterka::trace {

// Times `step` apart; touch is the one with the index `before`, where the force has jumped.
struct WindowPlan {
    std::size_t touch = 0;  // which one of the trace
    double touch_time = 0;  // tau since the trace began
    double step = 0;
    std::int64_t before = 0;  // samples before touch
    std::int64_t after = 0;   // from touch on
};

// `share_before` of the width lies before touch; samples outside the trace are omitted.
[[nodiscard]] WindowPlan plan_window(std::size_t touch, double touch_time, double width, double share_before,
                                     std::int64_t samples, double trace_length);

class ImpactWindow : public Watcher {
  public:
    ImpactWindow(const scene::Oscillator<double>& oscillator, const WindowPlan& plan)
        : oscillator_(oscillator), plan_(plan) {}

    [[nodiscard]] const std::vector<Instant>& instants() const { return instants_; }
    // The largest force of the impact, located on the motion itself; not for a rigid stop.
    [[nodiscard]] const Instant& peak() const { return peak_; }

    void touch(double speed) override;
    void leave(const trajectory::ImpactRecord<double>& impact) override;

  private:
    void look(const Stretch& stretch) override;
    void sample(const Stretch& stretch);
    void raise_peak(const Stretch& stretch);
    [[nodiscard]] Instant instant(const Stretch& stretch, double time) const;  // since the stretch began

    scene::Oscillator<double> oscillator_;
    WindowPlan plan_;
    std::vector<Instant> instants_;
    Instant peak_;
    double largest_ = 0;
    std::size_t touches_ = 0;
    bool lasts_ = false;  // the impact of the plan
};

}  // namespace peterka::trace
