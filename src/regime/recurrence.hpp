// Candidates for periodic motion: the smallest lag at which a trajectory nearly returns with the same contacts
// and does not stretch a perturbation meanwhile (inside chaos near-returns abound, and each would cost a Newton
// solve).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

class Recurrence {
  public:
    // untouched: whether motions without contact are candidates too.
    Recurrence(std::int64_t longest, bool untouched)
        : longest_(longest),
          untouched_(untouched),
          entries_(static_cast<std::size_t>(2 * longest + 1)),
          tried_at_(static_cast<std::size_t>(longest + 1), first_distance) {}

    // Records the state after one more cycle and that cycle's events.
    void record(const Passage& cycle) {
        ++recorded_;
        if (cycle.touched) last_touch_ = recorded_;
        entry(recorded_) = {cycle.end, cycle.jacobian, cycle.pattern};
    }

    [[nodiscard]] const Point& state() const { return entry(recorded_).state; }
    // Pattern of the last q cycles.
    [[nodiscard]] EventPattern pattern(std::int64_t q) const {
        EventPattern pattern = 0;
        for (std::int64_t i = q - 1; i >= 0; --i) pattern = append(pattern, entry(recorded_ - i).pattern);
        return pattern;
    }

    // The smallest q for which the state is close to that of q cycles ago, the last q patterns equal the q
    // before, and the distance fell well below that of the last try at this q. Asking counts as trying.
    [[nodiscard]] std::optional<std::int64_t> candidate() {
        const Entry& now = entry(recorded_);
        for (std::int64_t q = 1; q <= longest_ && 2 * q < recorded_; ++q) {
            if (entry(recorded_ - q).pattern != now.pattern) continue;
            if (recorded_ - last_touch_ >= q && !untouched_) continue;
            const double distance = (now.state - entry(recorded_ - q).state).lpNorm<Eigen::Infinity>();
            const double tried_at = tried_at_[static_cast<std::size_t>(q)];
            if (!(distance < retry_factor * tried_at) || !patterns_repeat(q) || stretches(q)) continue;
            // a multiple of q would lead to the same orbit again
            for (std::int64_t multiple = q; multiple <= longest_; multiple += q) {
                double& tried = tried_at_[static_cast<std::size_t>(multiple)];
                tried = std::min(tried, distance);
            }
            return q;
        }
        return std::nullopt;
    }

  private:
    // A return within a tenth of the forced amplitude is worth a Newton solve; a failed one is worth another
    // once the distance has fallen to 0.3 of itself.
    static constexpr double retry_factor = 0.3;
    static constexpr double first_distance = 0.1 / retry_factor;
    // On the way to a stable orbit the Jacobian comes close to the orbit's, whose spectral radius is below 1.
    static constexpr double largest_stretch = 1.2;

    struct Entry {
        Point state = Point::Zero();
        Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
        EventPattern pattern = 0;
    };
    [[nodiscard]] Entry& entry(std::int64_t cycle) {
        return entries_[static_cast<std::size_t>(cycle) % entries_.size()];
    }
    [[nodiscard]] const Entry& entry(std::int64_t cycle) const {
        return entries_[static_cast<std::size_t>(cycle) % entries_.size()];
    }
    [[nodiscard]] bool patterns_repeat(std::int64_t q) const {
        for (std::int64_t i = 1; i < q; ++i) {
            if (entry(recorded_ - i).pattern != entry(recorded_ - q - i).pattern) return false;
        }
        return true;
    }

    [[nodiscard]] bool stretches(std::int64_t q) const {
        Eigen::Matrix2d product = Eigen::Matrix2d::Identity();
        for (std::int64_t i = q - 1; i >= 0; --i) product = (entry(recorded_ - i).jacobian * product).eval();
        return !(spectral_radius(product) < largest_stretch);
    }

    std::int64_t longest_;
    bool untouched_;
    std::vector<Entry> entries_;
    std::vector<double> tried_at_;
    std::int64_t recorded_ = 0;
    std::int64_t last_touch_ = 0;
};

}  // namespace peterka::regime
