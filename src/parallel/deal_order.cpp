#include "parallel/deal_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace peterka::parallel {
namespace {

std::int64_t part_of(std::int64_t count, double share) {
    return std::lround(share * static_cast<double>(count));
}

// On the torus with sides of length 1.
double distance(std::int64_t tiles, std::int64_t side) {
    return static_cast<double>(std::min(tiles, side - tiles)) / static_cast<double>(side);
}

// How far apart consecutive turns lie: the least squared distance of two tiles times the turns between them, up
// to 256 turns.
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

// Steps by 0.755 of the rows and 0.570 of the columns: the low-discrepancy additive recurrence in the plane
// with the powers of 1/g, g^3 = g + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
// The stride must be coprime to the number of tiles, and rounding can lead back to a neighbour after a few
// turns, so the best of the first 16 admissible strides is taken.
std::int64_t stride_in(const Extent& grid) {
    const std::int64_t all = grid.rows * grid.columns;
    if (all < 2) return 1;
    const std::int64_t wanted =
        part_of(grid.rows, 0.7548776662466927) * grid.columns + part_of(grid.columns, 0.5698402909980532);
    // products must not overflow: beyond 3e9 tiles, files of 20 TB and more, the order is less even
    const std::int64_t largest = std::numeric_limits<std::int64_t>::max() / all / 2;
    std::int64_t best = 1;
    double widest = 0;
    int candidates = 0;
    for (std::int64_t stride = std::clamp<std::int64_t>(wanted % all, 1, largest); candidates < 16; ++stride) {
        if (std::gcd(stride, all) != 1) continue;
        ++candidates;
        const double its_spread = spread(stride, grid);
        if (its_spread <= widest) continue;
        widest = its_spread;
        best = stride;
    }
    return best;
}

// Chaotic tiles take some 50 times the mean. From 3500 tiles per rank on, the last quarter takes longer than a
// square of such tiles, so no rank waits for one.
std::int64_t side_for(std::int64_t tiles, int ranks) {
    constexpr std::int64_t many = 3500;
    return tiles / ranks >= many ? 4 : 1;
}

constexpr std::int64_t squares_along(std::int64_t tiles, std::int64_t side) {
    return (tiles + side - 1) / side;
}

}  // namespace

DealOrder::DealOrder(const Tiling& tiling, int ranks)
    : grid_(tiling.tiles()),
      side_(side_for(tiling.count(), ranks)),
      squares_{squares_along(grid_.rows, side_), squares_along(grid_.columns, side_)},
      stride_(stride_in(squares_)),
      first_alone_(side_ == 1 ? turns() : squares_.rows * squares_.columns * 3 / 4 * side_ * side_),
      alone_stride_(stride_in({1, std::max<std::int64_t>(turns() - first_alone_, 1)})) {}

std::optional<std::int64_t> DealOrder::tile(std::int64_t turn) const {
    const std::int64_t place =
        turn < first_alone_ ? turn
                            : first_alone_ + (turn - first_alone_) * alone_stride_ % (turns() - first_alone_);
    const std::int64_t square = place / (side_ * side_) * stride_ % (squares_.rows * squares_.columns);
    const std::int64_t within = place % (side_ * side_);
    const std::int64_t row = square / squares_.columns * side_ + within / side_;
    const std::int64_t column = square % squares_.columns * side_ + within % side_;
    if (row >= grid_.rows || column >= grid_.columns) return std::nullopt;
    return row * grid_.columns + column;
}

}  // namespace peterka::parallel
