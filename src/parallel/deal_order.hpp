// The order in which tiles are dealt: each has its turn, and any stretch of turns is scattered over the whole
// grid.
//
// Costly cells lie side by side. Tiles dealt in such an order cost about the same in any run, so ranks finish
// together (postprocess/scaling.py shows it), the time left can be told from what is done, and the file of a
// run that was stopped shows all of the map in part.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace peterka::parallel {

class DealOrder {
  public:
    // A stride near the golden section of all tiles: its multiples, modulo the number of tiles, fall into the
    // largest gaps between those before (Knuth, The Art of Computer Programming, vol. 3, section 6.4).
    explicit DealOrder(std::int64_t tiles) : tiles_(tiles), stride_(1) {
        if (tiles < 2) return;
        constexpr double golden = 0.6180339887498949;
        // so that no product overflows
        stride_ = std::min(static_cast<std::int64_t>(golden * static_cast<double>(tiles)),
                           std::numeric_limits<std::int64_t>::max() / tiles - 64);
        while (std::gcd(stride_, tiles) != 1) ++stride_;
    }

    [[nodiscard]] std::int64_t tile(std::int64_t turn) const { return turn * stride_ % tiles_; }

  private:
    std::int64_t tiles_;
    std::int64_t stride_;
};

}  // namespace peterka::parallel
