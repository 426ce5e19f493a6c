// The motion in which a search ends, for continuation or plotting.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/oscillator.hpp"
#include "support/latest.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// For an orbit, all of it: its q points in order from the one with the smallest delta, and the first touches of
// one period from there. For a motion without a proof, the last ones of the window in which force is measured.
// At most `room` of each, the last ones; none if the cell failed.
struct SteadyMotion {
    explicit SteadyMotion(std::size_t room) : stroboscopic(room), touches(room) {}

    Latest<scene::State<double>> stroboscopic;  // (delta, delta') at forcing phase 0
    Latest<trajectory::Touch<double>> touches;  // of impacts
    std::optional<scene::State<double>> end =
        {};  // (delta, delta') at forcing phase 0, after whole cycles from the
             // start: the point of the orbit to which the trajectory contracts,
             // or where it is when the search gives up; none where it failed
};

// Records a motion if requested.
class MotionLog {
  public:
    using State = scene::State<double>;

    // motion: nullptr if not requested; outlives the log.
    explicit MotionLog(SteadyMotion* motion) : motion_(motion) { forget(); }

    [[nodiscard]] bool is_wanted() const { return motion_ != nullptr; }
    [[nodiscard]] Latest<trajectory::Touch<double>>* touches() const {
        return is_wanted() ? &motion_->touches : nullptr;
    }
    // Adds a point of a motion without a proof.
    void add(const State& point) {
        if (is_wanted()) motion_->stroboscopic.add(point);
    }
    // The motion is an orbit; `reached`: the number of the point that the trajectory is close to.
    void settle_on(std::span<const State> points, std::size_t reached) {
        if (!is_wanted()) return;
        motion_->stroboscopic.clear();
        for (const State& point : points) motion_->stroboscopic.add(point);
        motion_->end = points[reached];
    }
    void forget_touches() {
        if (is_wanted()) motion_->touches.clear();
    }
    // The search gave up at this state.
    void end_at(const State& state) {
        if (is_wanted()) motion_->end = state;
    }
    void forget() {
        if (is_wanted()) *motion_ = SteadyMotion(motion_->touches.capacity());
    }

  private:
    SteadyMotion* motion_;
};

}  // namespace peterka::regime
