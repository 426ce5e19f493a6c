// Observations of a motion, cycle by cycle, and those that enter a cell's result.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "regime/cell_result.hpp"
#include "regime/steady_motion.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// The quantities measured of a steady state.
struct Measures {
    trajectory::Detail detail = trajectory::Detail::force;
    bool force_per_cycle = false;
    SteadyMotion* motion = nullptr;  // filled if requested; outlives the search

    // Whether a cycle must not be integrated before the previous one was examined.
    [[nodiscard]] bool look_at_each_cycle() const { return force_per_cycle || motion != nullptr; }
};

class Observation {
  public:
    // period: of the forcing, in tau.
    Observation(const Measures& measures, double period)
        : detail_(measures.detail),
          force_per_cycle_(measures.force_per_cycle),
          period_(period),
          recorder_(measures.detail, MotionLog(measures.motion).touches()) {}

    // Collects the events in the cycles that count.
    [[nodiscard]] trajectory::Recorder<double>& recorder() { return recorder_; }
    [[nodiscard]] const trajectory::Totals<double>& totals() const { return recorder_.totals(); }
    // Whether an event is in progress at the end of a cycle; it counts in a later one.
    [[nodiscard]] bool is_open() const { return recorder_.is_open(); }
    // Ends a cycle that counts.
    void end_cycle() {
        ++cycles_;
        if (force_per_cycle_) peaks_.push_back(recorder_.take_recent_force());
    }
    // Restarts the counts; open events stay open.
    void begin_again() {
        recorder_.reset_totals();
        peaks_.clear();
        cycles_ = 0;
    }
    // Ends the observation of the motion.
    void finish() { recorder_.finish(); }

    // Means are over the cycles that counted.
    void write_to(CellResult& result);

  private:
    void write_force_per_cycle(CellResult& result);

    trajectory::Detail detail_;
    bool force_per_cycle_;
    double period_;
    trajectory::Recorder<double> recorder_;
    std::vector<double> peaks_;  // of the cycles that count
    std::int64_t cycles_ = 0;
};

}  // namespace peterka::regime
