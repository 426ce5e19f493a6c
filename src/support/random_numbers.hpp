// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea & Flood 2014, OOPSLA).
#pragma once

#include <cmath>
#include <cstdint>

namespace peterka {

class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint64_t seed = 0) : seed_(seed) {}

    // All 64 bits at random.
    std::uint64_t bits() {
        seed_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t mixed = seed_;
        mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
        mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebULL;
        return mixed ^ (mixed >> 31U);
    }
    // Uniform in [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
    // One of 0 to count - 1.
    std::uint64_t below(std::uint64_t count) {
        return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
    }
    // Normal, with mean 0 and standard deviation 1, by the polar method (Marsaglia & Bray 1964, SIAM Rev. 6,
    // 260).
    double normal() {
        if (has_next_) {
            has_next_ = false;
            return next_;
        }
        for (;;) {
            const double x = 2 * uniform() - 1;
            const double y = 2 * uniform() - 1;
            const double square = x * x + y * y;
            if (square >= 1 || square == 0) continue;
            const double scale = std::sqrt(-2 * std::log(square) / square);
            next_ = scale * y;
            has_next_ = true;
            return scale * x;
        }
    }

  private:
    std::uint64_t seed_;
    double next_ = 0;
    bool has_next_ = false;
};

}  // namespace peterka
