// The trajectory from a start, followed cycle by cycle: which cycles are ordered ahead, where it is, and what
// was observed in the cycles that count for a motion without a period.
//
// At first cycles are ordered one by one, as most motions settle soon. A motion that didn't is ordered in
// blocks, and looked at by checkpoints at their ends: so what is ordered meanwhile finds none of their cycles
// left.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "job/job.hpp"
#include "regime/growth.hpp"
#include "regime/observation.hpp"
#include "regime/recurrence.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

// From which cycle on those of a motion without a period count: the first ones belong to its transient.
[[nodiscard]] inline std::int64_t first_that_counts(const job::SteadyState& budget) {
    return std::min<std::int64_t>(Growth::settling_cycles, budget.max_cycles / 2);
}

class FollowedTrajectory {
  public:
    // last_cycle: behind which it isn't followed.
    FollowedTrajectory(const StroboscopicMap& map, const scene::State<double>& start,
                       const job::SteadyState& budget, std::int64_t last_cycle, const Measures& measures)
        : state_(map.scaled(start)),
          window_(measures, map.oscillator().period()),
          log_(measures.motion),
          measure_from_(first_that_counts(budget)),
          last_cycle_(last_cycle),
          one_by_one_(measures.look_at_each_cycle()) {}

    [[nodiscard]] const Point& state() const { return state_; }  // at the end of the last cycle
    [[nodiscard]] std::int64_t cycles() const { return cycles_; }
    [[nodiscard]] bool is_at_end() const { return cycles_ == last_cycle_; }
    // The first being 1; 0: none.
    [[nodiscard]] std::int64_t last_touched() const { return last_touched_; }
    [[nodiscard]] bool is_at_checkpoint() const { return cycles_ > 0 && is_checkpoint(cycles_); }
    [[nodiscard]] Observation& window() { return window_; }

    // Where no cycle ordered is left: take(co_await order(map)).
    [[nodiscard]] bool needs_order() const { return ahead_.empty(); }
    [[nodiscard]] auto order(StroboscopicMap& map) {
        return map.cycles(state_, counts() ? &window_.recorder() : nullptr, cycles_at_once());
    }
    void take(std::span<const trajectory::Cycle<double>> ordered) { ahead_ = ordered; }
    // Others are going to be ordered, which would take the place of those that weren't looked at yet.
    void keep_ordered() {
        kept_.assign(ahead_.begin(), ahead_.end());
        ahead_ = kept_;
    }
    // The next cycle of those ordered; where it failed the trajectory ends before it.
    [[nodiscard]] Passage advance(const StroboscopicMap& map) {
        Passage cycle = map.passage(ahead_.front());
        ahead_ = ahead_.subspan(1);
        if (!cycle.ok) return cycle;
        state_ = cycle.end;
        if (counts()) {
            window_.end_cycle();
            log_.add(map.unscaled(state_));
        }
        ++cycles_;
        if (cycle.touched) last_touched_ = cycles_;
        return cycle;
    }

  private:
    static_assert(Recurrence::early_cycles % Growth::block_cycles == 0);
    static bool is_checkpoint(std::int64_t cycle) {
        return cycle <= Recurrence::early_cycles || cycle % Growth::block_cycles == 0;
    }
    [[nodiscard]] bool counts() const { return cycles_ >= measure_from_; }
    // No cycle goes beyond the one from which on they count.
    [[nodiscard]] std::size_t cycles_at_once() const {
        if (one_by_one_ || cycles_ < Recurrence::early_cycles || !is_checkpoint(cycles_)) return 1;
        const std::int64_t turn = counts() ? last_cycle_ : std::min(measure_from_, last_cycle_);
        return turn - cycles_ < Growth::block_cycles ? 1 : Growth::block_cycles;
    }

    Point state_;
    std::span<const trajectory::Cycle<double>> ahead_;  // integrated, and not looked at yet
    std::vector<trajectory::Cycle<double>> kept_;       // a copy of these
    std::int64_t cycles_ = 0;
    std::int64_t last_touched_ = 0;
    Observation window_;  // of the cycles that count
    MotionLog log_;
    std::int64_t measure_from_;
    std::int64_t last_cycle_;
    bool one_by_one_;
};

}  // namespace peterka::regime
