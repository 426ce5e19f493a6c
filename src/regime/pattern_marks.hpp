// The event patterns of a trajectory, cycle by cycle, in 16 bits each: a first comparison at many lags at once.
// Equal patterns have equal marks; equal marks must be confirmed on the patterns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "support/reused_memory.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::regime {

// Marks are stored newest first and added in front: so any lag is an address, and rows of cycles compare as
// bytes.
class PatternMarks {
  public:
    // kept: minimum number of cycles whose marks are kept.
    explicit PatternMarks(std::size_t kept) : kept_(kept) {}

    void add(trajectory::EventPattern pattern) {
        if (newest_ == 0) make_room();
        marks_[--newest_] = static_cast<Mark>(pattern ^ (pattern >> 16U) ^ (pattern >> 32U));
    }
    // Whether the last cycle has the mark of the cycle `lag` cycles before.
    [[nodiscard]] bool repeats(std::int64_t lag) const { return at(lag) == at(0); }
    // Whether the last `cycles` cycles have the marks of those `lag` cycles before them.
    [[nodiscard]] bool repeat(std::int64_t cycles, std::int64_t lag) const {
        return std::memcmp(&at(0), &at(lag), static_cast<std::size_t>(cycles) * sizeof(Mark)) == 0;
    }

  private:
    using Mark = std::uint16_t;

    [[nodiscard]] const Mark& at(std::int64_t ago) const {
        return marks_[newest_ + static_cast<std::size_t>(ago)];
    }
    void make_room() {
        std::vector<Mark, ReusingAllocator<Mark>> moved(2 * kept_);
        std::copy_n(marks_.begin(), std::min(kept_, marks_.size()),
                    moved.begin() + static_cast<std::ptrdiff_t>(kept_));
        marks_.swap(moved);
        newest_ = kept_;
    }

    std::size_t kept_;
    std::vector<Mark, ReusingAllocator<Mark>> marks_;
    std::size_t newest_ = 0;
};

}  // namespace peterka::regime
