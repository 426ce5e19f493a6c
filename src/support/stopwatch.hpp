// Wall time since construction [s]; a steady clock, unaffected by setting the system's clock.
#pragma once

#include <chrono>

namespace peterka {

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace peterka
