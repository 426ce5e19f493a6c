#include "parallel/deal_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace peterka::parallel {
namespace {

std::int64_t part_of(std::int64_t count, double share) {
    return static_cast<std::int64_t>(share * static_cast<double>(count) + 0.5);
}

// The plane without edges, its sides 1 long.
double distance(std::int64_t tiles, std::int64_t side) {
    return static_cast<double>(std::min(tiles, side - tiles)) / static_cast<double>(side);
}

// How far turns lie apart: the least squared distance of two tiles times the turns between them, up to 256.
double spread(std::int64_t stride, const Extent& grid) {
    const std::int64_t tiles = grid.rows * grid.columns;
    double least = 1;
    for (std::int64_t turns = 1; turns <= std::min<std::int64_t>(tiles - 1, 256); ++turns) {
        const std::int64_t tile = turns * stride % tiles;
        const double up = distance(tile / grid.columns, grid.rows);
        const double along = distance(tile % grid.columns, grid.columns);
        least = std::min(least, static_cast<double>(turns) * (up * up + along * along));
    }
    return least;
}

}  // namespace

// By 0.755 of the rows and 0.570 of the columns: the additive recurrence of low discrepancy in the plane by the
// powers of 1/g, g^3 = g + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). The
// stride must have no factor in common with the number of tiles, and rounding can lead back next door after a
// few turns, so the best of the first 16 strides from there on is taken.
DealOrder::DealOrder(const Tiling& tiling) : tiles_(tiling.count()), stride_(1) {
    if (tiles_ < 2) return;
    const Extent grid = tiling.tiles();
    const std::int64_t wanted =
        part_of(grid.rows, 0.7548776662466927) * grid.columns + part_of(grid.columns, 0.5698402909980532);
    // products must not overflow: beyond 3e9 tiles, files of 20 TB, the order is less even
    const std::int64_t largest = std::numeric_limits<std::int64_t>::max() / tiles_ / 2;
    std::int64_t stride = std::clamp<std::int64_t>(wanted % tiles_, 1, largest);
    double widest = 0;
    for (int candidates = 0; candidates < 16; ++stride) {
        if (std::gcd(stride, tiles_) != 1) continue;
        ++candidates;
        const double its_spread = spread(stride, grid);
        if (its_spread <= widest) continue;
        widest = its_spread;
        stride_ = stride;
    }
}

}  // namespace peterka::parallel
