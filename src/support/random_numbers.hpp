// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea & Flood 2014, OOPSLA).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

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
    // Normal, with mean 0 and standard deviation 1 (Box & Muller 1958, Ann. Math. Statist. 29, 610).
    double normal() {
        if (has_next_) {
            has_next_ = false;
            return next_;
        }
        const double radius = std::sqrt(-2 * std::log1p(-uniform()));
        const double angle = 2 * std::numbers::pi * uniform();
        next_ = radius * std::sin(angle);
        has_next_ = true;
        return radius * std::cos(angle);
    }

  private:
    std::uint64_t seed_;
    double next_ = 0;
    bool has_next_ = false;
};

}  // namespace peterka
