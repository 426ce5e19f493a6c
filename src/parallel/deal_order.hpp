// The order in which tiles are dealt: each has its turn, and turns that follow each other are scattered over
// the plane.
//
// Costly cells lie side by side. In such an order runs of tiles cost about the same, so ranks finish together
// (postprocess/scaling.py shows it), the time left can be told from what is done, and the file of a run that
// was stopped shows all of the map in part.
#pragma once

#include <cstdint>

#include "parallel/tiles.hpp"

namespace peterka::parallel {

// Turns first, first + 1, ..., end - 1 of a DealOrder.
struct Turns {
    std::int64_t first = 0;
    std::int64_t end = 0;

    [[nodiscard]] std::int64_t size() const { return end - first; }
    friend bool operator==(const Turns&, const Turns&) = default;
};

class DealOrder {
  public:
    // From turn to turn by one stride, in a circle of all tiles.
    explicit DealOrder(const Tiling& tiling);

    [[nodiscard]] std::int64_t tiles() const { return tiles_; }
    [[nodiscard]] std::int64_t tile(std::int64_t turn) const { return turn * stride_ % tiles_; }

  private:
    std::int64_t tiles_;
    std::int64_t stride_;
};

}  // namespace peterka::parallel
