// What those starts of a cell end in that are followed for long, and so for how long the next ones are.
//
// Chaos is told by following it, for chaos_cycles or more, and what has no proof for max_cycles: a few starts
// would take most of the cycles of a map. But a start that has no proof after a few hundred cycles has
// forgotten where it began, and ends in what such starts of its cell end in. The first of these are followed as
// any; once they are ten times as many as those that ended otherwise on the way (counting one more than were
// seen), the next ones are called by a shorter look. Whatever ends otherwise there counts again.
#pragma once

#include <algorithm>
#include <cstdint>

#include "job/job.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"

namespace peterka::attractors {

// What later starts are called sooner.
struct EarlyVerdict {
    bool chaos = false;       // as regime::SearchContext::chaos
    bool unresolved = false;  // after a part of the cycles
};

class Prospects {
  public:
    // Of a start, in any order.
    void take(const regime::CellResult& result) {
        chaos_.take(result, result.regime == regime::Regime::chaotic,
                    result.sensitivity > regime::rounding_decides);
        // chaos takes as long as it is followed
        unresolved_.take(result, result.regime == regime::Regime::unresolved,
                         result.regime != regime::Regime::chaotic);
    }
    [[nodiscard]] EarlyVerdict sooner() const {
        const bool chaos = chaos_.is_sure();
        return {chaos, unresolved_.is_sure() && (chaos || !chaos_.is_there())};
    }

    // The budget of starts that are unresolved sooner.
    [[nodiscard]] static job::SteadyState smaller(job::SteadyState budget) {
        budget.max_cycles = std::min(budget.max_cycles, max_cycles);
        return budget;
    }

  private:
    static constexpr std::int64_t max_cycles = 300;
    static constexpr double most_otherwise = 0.1;

    // Starts that were followed for more than a few cycles.
    class LongStarts {
      public:
        explicit LongStarts(std::int64_t few) : few_(few) {}
        // ends_so: as those that are to be called sooner. is_like: as long as its end wasn't known.
        void take(const regime::CellResult& result, bool ends_so, bool is_like) {
            const std::int64_t cycles = (ends_so ? result.observed_cycles : result.cycles) - few_;
            if (cycles <= 0 || (!ends_so && !is_like)) return;
            if (!ends_so) {
                ++otherwise_;
                return;
            }
            cycles_ += cycles;
            longest_ = std::max(longest_, cycles);
        }
        [[nodiscard]] bool is_there() const { return longest_ > 0; }
        [[nodiscard]] bool is_sure() const {
            const auto expected = static_cast<double>((otherwise_ + 1) * longest_);
            return is_there() && expected <= most_otherwise * static_cast<double>(cycles_);
        }

      private:
        std::int64_t few_;
        std::int64_t cycles_ = 0;  // beyond the few, of those that ended so
        std::int64_t longest_ = 0;
        std::int64_t otherwise_ = 0;
    };

    LongStarts chaos_{regime::SearchContext::cycles_to_settle};
    LongStarts unresolved_{max_cycles};
};

}  // namespace peterka::attractors
