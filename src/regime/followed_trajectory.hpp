// The trajectory from a start, followed cycle by cycle: the cycles ordered ahead, the present state, and the
// observations in the cycles that count for a motion without a period.
//
// At first each cycle is examined, as most motions settle soon; where a batch carries them, a few are ordered
// ahead, because a suspension costs more than they do. A motion that has not settled is ordered in blocks, and
// examined at checkpoints at their ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "job/job.hpp"
#include "regime/growth.hpp"
#include "regime/observation.hpp"
#include "regime/recurrence.hpp"
#include "regime/stroboscopic_map.hpp"
#include "support/reused_memory.hpp"

namespace peterka::regime {

// The first cycle that counts for a motion without a period: earlier ones belong to its transient.
[[nodiscard]] inline std::int64_t first_that_counts(const job::SteadyState& budget) {
    return std::min<std::int64_t>(Growth::settling_cycles, budget.max_cycles / 2);
}

class FollowedTrajectory {
  public:
    // last_cycle: after which the trajectory isn't followed.
    FollowedTrajectory(const StroboscopicMap& map, const scene::State<double>& start,
                       const job::SteadyState& budget, std::int64_t last_cycle, const Measures& measures)
        : state_(map.scaled(start)),
          window_(measures, map.oscillator().period()),
          log_(measures.motion),
          measure_from_(first_that_counts(budget)),
          last_cycle_(last_cycle),
          one_by_one_(measures.look_at_each_cycle()),
          early_at_once_(has_batch(map.oscillator(), map.engine()) ? few : 1) {}

    [[nodiscard]] const Point& state() const { return state_; }  // at the end of the last cycle
    [[nodiscard]] std::int64_t cycles() const { return cycles_; }
    [[nodiscard]] bool is_at_end() const { return cycles_ == last_cycle_; }
    // Number of the last cycle with contact, from 1; 0: none.
    [[nodiscard]] std::int64_t last_touched() const { return last_touched_; }
    [[nodiscard]] bool is_at_checkpoint() const { return cycles_ > 0 && is_checkpoint(cycles_); }
    // Whether to decide here, if possible, what the motion has settled to.
    [[nodiscard]] bool is_to_be_looked_at() const { return needs_order() || is_early(); }
    // Cycles ordered ahead for a motion that settles are not part of the search.
    [[nodiscard]] std::int64_t not_needed() const {
        return is_early() ? static_cast<std::int64_t>(ahead_.size()) : 0;
    }
    [[nodiscard]] Observation& window() { return window_; }

    // If no ordered cycle is left: take(co_await order(map)).
    [[nodiscard]] bool needs_order() const { return ahead_.empty(); }
    [[nodiscard]] auto order(StroboscopicMap& map) {
        return map.cycles(state_, counts() ? &window_.recorder() : nullptr, cycles_at_once());
    }
    void take(std::span<const trajectory::Cycle<double>> ordered) {
        ahead_ = ordered;
        keeps_ahead_ = false;
    }
    // Copies the ordered cycles not examined yet, before another order overwrites them.
    void keep_ordered() {
        if (ahead_.empty() || std::exchange(keeps_ahead_, true)) return;
        kept_.assign(ahead_.begin(), ahead_.end());
        ahead_ = kept_;
    }
    // The next of the ordered cycles; if it failed, the trajectory ends before it.
    [[nodiscard]] CycleResult advance(const StroboscopicMap& map) {
        CycleResult cycle = map.result_of(ahead_.front());
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
    static constexpr std::int64_t few = 5;  // a 1/1 motion of the paper's rig is found in 3 or 4
    static_assert(Recurrence::early_cycles % Growth::block_cycles == 0);
    static_assert(Recurrence::early_cycles % few == 0);
    [[nodiscard]] bool is_early() const { return cycles_ < Recurrence::early_cycles; }
    static bool is_checkpoint(std::int64_t cycle) {
        return cycle <= Recurrence::early_cycles || cycle % Growth::block_cycles == 0;
    }
    [[nodiscard]] bool counts() const { return cycles_ >= measure_from_; }
    // A block never crosses the cycle from which on cycles count.
    [[nodiscard]] std::size_t cycles_at_once() const {
        const std::int64_t many = is_early() ? early_at_once_ : Growth::block_cycles;
        if (one_by_one_ || !is_checkpoint(cycles_)) return 1;
        const std::int64_t turn = counts() ? last_cycle_ : std::min(measure_from_, last_cycle_);
        return static_cast<std::size_t>(turn - cycles_ < many ? 1 : many);
    }

    Point state_;
    std::span<const trajectory::Cycle<double>> ahead_;  // integrated, not examined yet
    std::vector<trajectory::Cycle<double>, ReusingAllocator<trajectory::Cycle<double>>>
        kept_;  // a copy of these
    bool keeps_ahead_ = false;
    std::int64_t cycles_ = 0;
    std::int64_t last_touched_ = 0;
    Observation window_;  // of the cycles that count
    MotionLog log_;
    std::int64_t measure_from_;
    std::int64_t last_cycle_;
    bool one_by_one_;
    std::int64_t early_at_once_;
};

}  // namespace peterka::regime
