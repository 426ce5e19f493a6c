// The mean lifetime of transient chaos from which some starts of a cell escape.
//
// Escapes occur at random, equally often in late and early cycles: so the mean lifetime is the total time for
// which starts were seen on the chaos, whether they escaped or not, divided by the number of escapes. A start
// is on the chaos once it has forgotten where it began; starts that end before that do not count.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "regime/cell_result.hpp"

namespace peterka::attractors {

class MeanLife {
  public:
    // Adds a start; the order does not matter.
    void take(const regime::CellResult& result) {
        if (result.forgot_after == 0) return;
        // a softening spring may throw the hammer out
        const bool thrown_out =
            result.regime == cell::Regime::failed && result.status == cell::Status::not_finite;
        const bool escaped = thrown_out || cell::has_period(result.regime);
        // a start that ended on an orbit reached it shortly before that was proved; without impacts, after the
        // last one
        const std::int64_t end =
            result.regime == cell::Regime::no_impact ? result.last_impact : result.followed_cycles;
        if (escaped && end <= result.forgot_after) return;
        cycles_ += std::max<std::int64_t>(end - result.forgot_after, 0);
        escapes_ += escaped ? 1 : 0;
    }

    // In forcing cycles, with its standard error; NaN if no start escaped.
    [[nodiscard]] double mean() const {
        return escapes_ > 0 ? static_cast<double>(cycles_) / static_cast<double>(escapes_) : cell::unknown;
    }
    [[nodiscard]] double error() const { return mean() / std::sqrt(static_cast<double>(escapes_)); }

  private:
    std::int64_t cycles_ = 0;
    std::int64_t escapes_ = 0;
};

}  // namespace peterka::attractors
