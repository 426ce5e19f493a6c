// Candidates for periodic motion: the smallest lag at which a trajectory nearly returns with the same contacts
// and does not stretch a perturbation meanwhile (inside chaos near-returns abound, and each would cost a Newton
// solve).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
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
          ring_(std::bit_ceil(static_cast<std::size_t>(2 * longest + 1))),
          untouched_(untouched),
          repeats_(static_cast<std::size_t>((longest + block - 1) / block * block)),
          some_repeats_(repeats_.size() / block) {
        entries_.reserve(16);
    }

    // Records the state after one more cycle and that cycle's events.
    void record(const Passage& cycle) {
        ++recorded_;
        if (cycle.touched) last_touch_ = recorded_;
        const Entry now{cycle.end, cycle.jacobian, cycle.pattern};
        if (entries_.size() < ring_) {
            entries_.push_back(now);
        } else {
            entry(recorded_) = now;
        }
        count_repeats(cycle.pattern);
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
            const auto lag = static_cast<std::size_t>(q - 1);
            if (lag % block == 0 && some_repeats_[lag / block] == 0) {
                q += block - 1;
                continue;
            }
            if (repeats_[lag] < q) continue;
            if (recorded_ - last_touch_ >= q && !untouched_) continue;
            const double distance = (now.state - entry(recorded_ - q).state).lpNorm<Eigen::Infinity>();
            if (!(distance < retry_factor * tried_at(q)) || !patterns_repeat(q) || stretches(q)) continue;
            // a multiple of q would lead to the same orbit again
            tried_at_.resize(static_cast<std::size_t>(longest_ + 1), first_distance);
            for (std::int64_t multiple = q; multiple <= longest_; multiple += q) {
                double& tried = tried_at_[static_cast<std::size_t>(multiple)];
                tried = std::min(tried, distance);
            }
            return q;
        }
        return std::nullopt;
    }

  private:
    static constexpr std::int64_t block = 16;  // of lags that are looked at together

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
    // Of cycles 1, 2, ...: the last ring_ of them are kept.
    [[nodiscard]] Entry& entry(std::int64_t cycle) {
        return entries_[static_cast<std::size_t>(cycle - 1) & (ring_ - 1)];
    }
    [[nodiscard]] const Entry& entry(std::int64_t cycle) const {
        return entries_[static_cast<std::size_t>(cycle - 1) & (ring_ - 1)];
    }
    [[nodiscard]] double tried_at(std::int64_t q) const {
        return tried_at_.empty() ? first_distance : tried_at_[static_cast<std::size_t>(q)];
    }

    // For all lags at once, as inside chaos hardly any is worth a closer look: how many patterns in a row equal
    // those of so many cycles before. Patterns are told apart by 16 bits here; candidate() looks at all of
    // them.
    void count_repeats(EventPattern pattern) {
        const auto now = static_cast<std::uint16_t>(pattern ^ (pattern >> 16U) ^ (pattern >> 32U));
        const std::size_t kept = repeats_.size();
        if (newest_ == 0) {  // marks lie newest first and are added in front
            const std::size_t room = 3 * kept;
            std::vector<std::uint16_t> moved(room + kept);
            std::copy_n(marks_.begin(), std::min(kept, marks_.size()),
                        moved.begin() + static_cast<std::ptrdiff_t>(room));
            marks_.swap(moved);
            newest_ = room;
        }
        const std::uint16_t* ago = &marks_[newest_];  // ago[q - 1]: q cycles before
        const std::size_t lags =
            std::min(kept, static_cast<std::size_t>(recorded_ + block - 1) / block * block);
        for (std::size_t first = 0; first < lags; first += block) {
            std::uint16_t* repeats = &repeats_[first];
            auto lag = static_cast<std::uint16_t>(first);
            std::uint16_t some = 0;
            for (std::size_t n = 0; n < block; ++n, ++lag) {
                const auto longer = static_cast<std::uint16_t>(repeats[n] + 1U);
                repeats[n] = ago[first + n] == now ? longer : std::uint16_t{0};
                some = static_cast<std::uint16_t>(some | std::uint16_t{repeats[n] > lag});
            }
            some_repeats_[first / block] = some;
        }
        marks_[--newest_] = now;
    }

    [[nodiscard]] bool patterns_repeat(std::int64_t q) const {
        for (std::int64_t i = 0; i < q; ++i) {
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
    std::size_t ring_;
    bool untouched_;
    std::vector<Entry> entries_;
    std::vector<double> tried_at_;
    std::vector<std::uint16_t> repeats_;       // by lag - 1
    std::vector<std::uint16_t> some_repeats_;  // by block of lags: whether one may repeat
    std::vector<std::uint16_t> marks_;         // of patterns, the newest at newest_
    std::size_t newest_ = 0;
    std::int64_t recorded_ = 0;
    std::int64_t last_touch_ = 0;
};

}  // namespace peterka::regime
