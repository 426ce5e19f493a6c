// The fate of a cell's long starts so far, and hence for how long later starts are followed.
//
// Chaos is recognized by following a start for chaos_cycles or more, and a start without a proof is followed
// for max_cycles: a few starts would take most of the cycles of a map. But a start without a proof after a few
// hundred cycles has forgotten where it began, and ends as such starts of its cell do. The first of these are
// followed in full; once they are ten times as many as those that ended otherwise meanwhile (counting one more
// than were seen), later ones are classified after a shorter run. Any that end otherwise there count again.
#pragma once

#include <algorithm>
#include <cstdint>

#include "job/job.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"

namespace peterka::attractors {

// Verdicts given earlier for later starts.
struct EarlyVerdict {
    bool chaos = false;       // as regime::SearchContext::chaos
    bool unresolved = false;  // after part of the cycles
};

class Prospects {
  public:
    // Adds a start; the order does not matter.
    void take(const regime::CellResult& result) {
        chaos_.take(result, result.regime == regime::Regime::chaotic,
                    result.sensitivity > regime::rounding_decides);
        // chaos takes a full run to recognize
        unresolved_.take(result, result.regime == regime::Regime::unresolved,
                         result.regime != regime::Regime::chaotic);
    }
    [[nodiscard]] EarlyVerdict sooner() const {
        const bool chaos = chaos_.is_sure();
        return {chaos, unresolved_.is_sure() && (chaos || !chaos_.is_there())};
    }

    // The budget of starts that are called unresolved early.
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
        // ends_so: it ended as the starts to be called early do. is_like: it looked so until its end was known.
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
        std::int64_t cycles_ = 0;  // beyond the few, of starts that ended so
        std::int64_t longest_ = 0;
        std::int64_t otherwise_ = 0;
    };

    LongStarts chaos_{regime::SearchContext::cycles_to_settle};
    LongStarts unresolved_{max_cycles};
};

}  // namespace peterka::attractors
