// Candidates for periodic motion: the smallest lag at which a trajectory nearly returns with the same contacts
// and without stretching a perturbation meanwhile (in chaos near-returns abound, and each would cost a Newton
// solve).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "regime/orbit_round.hpp"
#include "regime/pattern_marks.hpp"
#include "regime/stroboscopic_map.hpp"
#include "support/reused_memory.hpp"

namespace peterka::regime {

class Recurrence {
  public:
    static constexpr std::int64_t early_cycles = 50;  // in which most motions settle that settle at all

    // untouched: whether motions without contact are candidates too.
    Recurrence(std::int64_t longest, bool untouched)
        : longest_(longest),
          ring_(std::bit_ceil(static_cast<std::size_t>(2 * longest + 1))),
          untouched_(untouched),
          marks_(static_cast<std::size_t>(2 * longest + late_repeats)) {}

    // Records the state after one more cycle and that cycle's events.
    void record(const CycleResult& cycle) {
        ++recorded_;
        if (cycle.touched) last_touch_ = recorded_;
        const CycleRecord now{cycle.pattern, cycle.jacobian.cast<float>()};
        if (states_.size() < ring_) {
            states_.push_back(cycle.end);
            records_.push_back(now);
        } else {
            states_[place(recorded_)] = cycle.end;
            records_[place(recorded_)] = now;
        }
        marks_.add(cycle.pattern);
    }

    // How many periods of q cycles are kept with the state before them.
    [[nodiscard]] std::int64_t whole_periods(std::int64_t q) const {
        return (static_cast<std::int64_t>(states_.size()) - 1) / q;
    }
    // The state at the end of the last cycle, or q cycles before.
    [[nodiscard]] const Point& state(std::int64_t q = 0) const { return states_[place(recorded_ - q)]; }
    // Pattern of q consecutive cycles, of which the last ended `ago` cycles ago.
    [[nodiscard]] EventPattern pattern(std::int64_t q, std::int64_t ago = 0) const {
        EventPattern pattern = 0;
        for (std::int64_t i = q - 1; i >= 0; --i)
            pattern = append(pattern, record_of(recorded_ - ago - i).pattern);
        return pattern;
    }
    // The q states that end one cycle before the state of `ago` cycles ago, moved by one Newton step towards an
    // orbit of q cycles.
    [[nodiscard]] Points closed(std::int64_t q, std::int64_t ago = 0) const {
        // the states are those of the trajectory: only the last one misses its successor
        OrbitRound round(q);
        Points points;
        for (std::int64_t i = q; i > 0; --i) points.push_back(state(ago + i));
        for (std::int64_t i = q - 1; i >= 0; --i) {
            CycleResult cycle;
            cycle.end = state(ago + i);
            cycle.jacobian = record_of(recorded_ - ago - i).jacobian.cast<double>();
            round.add(cycle, points[static_cast<std::size_t>((q - i) % q)]);
        }
        std::ignore = round.correct(points);  // if that fails, they stay unchanged
        return points;
    }

    // How many cycles ago a state lay closest to that of q cycles earlier.
    [[nodiscard]] std::int64_t closest_return(std::int64_t q) const {
        std::int64_t closest = 0;
        double least = std::numeric_limits<double>::infinity();
        const auto kept = static_cast<std::int64_t>(states_.size());
        for (std::int64_t ago = 0; ago + q < kept; ++ago) {
            const double distance = (state(ago) - state(ago + q)).lpNorm<Eigen::Infinity>();
            if (distance >= least) continue;
            least = distance;
            closest = ago;
        }
        return closest;
    }

    // The smallest q for which the state is close to that of q cycles ago, the last q patterns equal the q
    // before, and the distance fell well below that of the last attempt at this q; 0 if there is none. A
    // returned q counts as attempted.
    [[nodiscard]] std::int64_t candidate() {
        const bool late = recorded_ > early_cycles;
        const Point now = state();
        Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();  // of the last `carried` cycles
        std::int64_t carried = 0;
        for (std::int64_t q = 1; q <= longest_ && 2 * q < recorded_; ++q) {
            if (!marks_.repeats(q)) continue;
            if (late && !marks_.repeat(late_repeats, q)) continue;
            if (recorded_ - last_touch_ >= q && !untouched_) continue;
            const double distance = (now - state(q)).lpNorm<Eigen::Infinity>();
            if (!(distance < retry_factor * tried_at(q)) || !patterns_repeat(q)) continue;
            for (; carried < q; ++carried) {
                jacobian = (jacobian * record_of(recorded_ - carried).jacobian.cast<double>()).eval();
            }
            if (!(spectral_radius(jacobian) < largest_stretch)) continue;
            // a multiple of q would lead to the same orbit again
            tried_at_.resize(static_cast<std::size_t>(longest_ + 1), first_distance);
            for (std::int64_t multiple = q; multiple <= longest_; multiple += q) {
                double& tried = tried_at_[static_cast<std::size_t>(multiple)];
                tried = std::min(tried, distance);
            }
            return q;
        }
        return 0;
    }

  private:
    // A return within a tenth of the forced amplitude is worth a Newton solve; after a failed one, another is
    // worthwhile once the distance has fallen to 0.3 of its value.
    static constexpr double retry_factor = 0.3;
    static constexpr double first_distance = 0.1 / retry_factor;
    // On the way to a stable orbit the Jacobian comes close to the orbit's, whose spectral radius is below 1.
    static constexpr double largest_stretch = 1.2;
    // A motion that didn't settle early must have repeated four patterns even if q is smaller.
    static constexpr std::int64_t late_repeats = 4;

    // Data of a cycle, besides the state at its end.
    struct CycleRecord {
        EventPattern pattern = 0;
        Eigen::Matrix2f jacobian = Eigen::Matrix2f::Identity();  // for estimates: half the memory
    };
    // Slot of cycle 1, 2, ...: the last ring_ of them are kept.
    [[nodiscard]] std::size_t place(std::int64_t cycle) const {
        return static_cast<std::size_t>(cycle - 1) & (ring_ - 1);
    }
    [[nodiscard]] const CycleRecord& record_of(std::int64_t cycle) const { return records_[place(cycle)]; }
    [[nodiscard]] double tried_at(std::int64_t q) const {
        return tried_at_.empty() ? first_distance : tried_at_[static_cast<std::size_t>(q)];
    }

    // Whether the last q patterns equal the q before.
    [[nodiscard]] bool patterns_repeat(std::int64_t q) const {
        if (!marks_.repeat(q, q)) return false;
        for (std::int64_t i = 0; i < q; ++i) {
            if (record_of(recorded_ - i).pattern != record_of(recorded_ - q - i).pattern) return false;
        }
        return true;
    }

    std::int64_t longest_;
    std::size_t ring_;
    bool untouched_;
    std::vector<Point, ReusingAllocator<Point>> states_;  // separate, as a search for candidates scans many
    std::vector<CycleRecord, ReusingAllocator<CycleRecord>> records_;
    std::vector<double, ReusingAllocator<double>> tried_at_;
    PatternMarks marks_;
    std::int64_t recorded_ = 0;
    std::int64_t last_touch_ = 0;
};

}  // namespace peterka::regime
