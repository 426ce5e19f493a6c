// The dealing policy: order, run lengths, and a pool with holes in which no tile is lost or dealt twice.
#include "parallel/tile_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace peterka::parallel {
namespace {

TileSet set_of(std::int64_t tiles, const std::vector<std::int64_t>& some) {
    TileSet set(tiles);
    for (const std::int64_t tile : some) set.add(tile);
    return set;
}

Tiling grid_of(std::int64_t rows, std::int64_t columns) {
    return Tiling({rows, columns}, {1, 1});
}

using Tiles = std::vector<std::int64_t>;

// Tiles of these turns; -1 for a turn without a tile.
Tiles dealt_by(const DealOrder& order, std::int64_t first_turn, std::int64_t turns) {
    Tiles dealt;
    for (std::int64_t turn = first_turn; turn < first_turn + turns; ++turn) {
        dealt.push_back(order.tile(turn).value_or(-1));
    }
    return dealt;
}

struct Dealing {
    std::int64_t rows;
    std::int64_t columns;
    int ranks;
};

TEST(DealOrder, EveryTileHasOneTurn) {
    const std::vector<Dealing> one_by_one{{1, 1, 1},  {1, 2, 1},   {2, 1, 3},  {3, 1, 1},
                                          {1, 30, 1}, {64, 64, 7}, {997, 1, 5}};
    const std::vector<Dealing> by_squares{{64, 64, 1}, {61, 59, 1}, {7001, 1, 2}};
    for (const auto& dealings : {one_by_one, by_squares}) {
        for (const auto& [rows, columns, ranks] : dealings) {
            const Tiling tiling = grid_of(rows, columns);
            const DealOrder order(tiling, ranks);
            Tiles dealt = dealt_by(order, 0, order.turns());
            std::erase(dealt, -1);
            std::ranges::sort(dealt);
            ASSERT_EQ(std::ssize(dealt), tiling.count()) << rows << " by " << columns;
            for (std::int64_t tile = 0; tile < tiling.count(); ++tile) {
                ASSERT_EQ(dealt[static_cast<std::size_t>(tile)], tile) << rows << " by " << columns;
            }
        }
    }
}

// The number of a square grid's 4 by 4 parts that contain any of these turns' tiles.
std::size_t parts_reached(const DealOrder& order, std::int64_t side, std::int64_t first_turn,
                          std::int64_t turns) {
    std::set<std::int64_t> reached;
    for (const std::int64_t tile : dealt_by(order, first_turn, turns)) {
        if (tile >= 0) reached.insert(tile / side * 4 / side * 4 + tile % side * 4 / side);
    }
    return reached.size();
}

TEST(DealOrder, FewTurnsReachAllPartsOfThePlane) {
    for (const std::int64_t side : {20, 64, 99, 128, 232, 376, 454}) {
        const DealOrder order(grid_of(side, side), 1000);
        for (const std::int64_t first : {std::int64_t{0}, side * side / 2}) {
            EXPECT_EQ(parts_reached(order, side, first, 64), 16U) << side << ", from turn " << first;
        }
    }
}

TEST(DealOrder, ManyTilesGoBySquaresAndTheLastOneByOne) {
    for (const std::int64_t side : {99, 128, 454}) {
        const DealOrder order(grid_of(side, side), 2);
        EXPECT_EQ(parts_reached(order, side, 0, 64 * 16), 16U) << side;
        EXPECT_EQ(parts_reached(order, side, order.turns() - 256, 256), 16U) << side;
        Tiles square;
        for (std::int64_t i = 0; i < 16; ++i) square.push_back(i / 4 * side + i % 4);
        EXPECT_EQ(dealt_by(order, 0, 16), square);
    }
}

TEST(DealOrder, IsKnown) {  // the replay in postprocess/ deals in the same order
    EXPECT_EQ(dealt_by(DealOrder(grid_of(64, 64), 3), 0, 4), (Tiles{0, 3111, 2126, 1141}));
    EXPECT_EQ(dealt_by(DealOrder(grid_of(5, 6), 1), 0, 4), (Tiles{0, 17, 4, 21}));
    const DealOrder by_squares(grid_of(64, 62), 1);
    EXPECT_EQ(dealt_by(by_squares, 14, 4), (Tiles{188, 189, 3020, 3021}));
    EXPECT_EQ(dealt_by(by_squares, 3072, 4), (Tiles{992, 3211, 1626, 2833}));
}

TEST(DealOrder, ManyTilesDontOverflow) {
    constexpr std::int64_t side = 1 << 27;  // the longest axes that a job may have
    for (const int ranks : {1, std::numeric_limits<int>::max()}) {
        const DealOrder order(grid_of(side, side), ranks);
        for (const std::int64_t turn :
             {std::int64_t{1}, order.turns() / 3, order.turns() / 2, order.turns() - 16}) {
            const Tiles near = dealt_by(order, turn, 16);
            EXPECT_EQ(std::set<std::int64_t>(near.begin(), near.end()).size(), 16U);
            for (const std::int64_t tile : near) EXPECT_TRUE(0 <= tile && tile < side * side) << tile;
        }
    }
}

TEST(TileSet, HoldsWhatWasAdded) {
    TileSet set(130);
    EXPECT_TRUE(set.empty());
    for (const std::int64_t tile : {0, 63, 64, 129, 64}) set.add(tile);
    EXPECT_FALSE(set.empty());
    EXPECT_EQ(set.size(), 4);
    for (std::int64_t tile = 0; tile < 130; ++tile) {
        EXPECT_EQ(set.has(tile), tile == 0 || tile == 63 || tile == 64 || tile == 129);
    }
    EXPECT_EQ(TileSet::all(130).size(), 130);
    EXPECT_EQ(TileSet(0).size(), 0);
}

TEST(DealSize, NoRunIsALargePartOfTheWork) {
    EXPECT_EQ(deal_size(16'000, 16'000, 10), 100);
    EXPECT_EQ(deal_size(10'000, 16'000, 10), 100);
    EXPECT_EQ(deal_size(1000, 1000, 1000), 1);
}

TEST(DealSize, TowardsTheEndHalfOfWhatRemainsGoesOutInOneRound) {
    EXPECT_EQ(deal_size(1000, 16'000, 10), 50);
    EXPECT_EQ(deal_size(1001, 16'000, 10), 51);  // rounded up
    EXPECT_EQ(deal_size(100, 16'000, 1), 50);
}

TEST(DealSize, NeverStopsAndNeverExceedsWhatRemains) {
    EXPECT_EQ(deal_size(1, 16'000, 7), 1);
    EXPECT_EQ(deal_size(13, 16'000, 7), 1);
    EXPECT_EQ(deal_size(1, 1, 1), 1);
    EXPECT_EQ(deal_size(0, 16'000, 7), 0);
    EXPECT_EQ(deal_size(0, 0, 7), 0);
}

TEST(DealSize, MessagesStayFewHoweverManyTiles) {
    constexpr std::int64_t tiles = 1'000'000;
    constexpr int ranks = 4;
    int deals = 0;
    for (std::int64_t remaining = tiles; remaining > 0 && deals < 10'000; ++deals) {
        remaining -= deal_size(remaining, tiles, ranks);
    }
    EXPECT_GT(deals, 120);  // 16 per rank, minus those replaced by the shrinking tail,
    EXPECT_LT(deals, 150);  // plus 2P ln(tiles/(16 P)) for that tail
}

TEST(CellsIn, CroppedTilesCountWhatTheyHold) {
    const Tiling tiling({20, 40});  // 2 by 3 tiles; the last column has 8 cells, the upper row 4
    EXPECT_EQ(cells_in(TileSet::all(6), tiling), 20 * 40);
    EXPECT_EQ(cells_in(set_of(6, {0, 2, 5}), tiling), 16 * 16 + 16 * 8 + 4 * 8);
    EXPECT_EQ(cells_in(TileSet(6), tiling), 0);
}

TEST(TilePool, RunsEndAtHoles) {
    const DealOrder order(grid_of(2, 5), 3);
    TileSet missing(10);
    for (const std::int64_t turn : {0, 1, 2, 5, 6, 9}) missing.add(order.tile(turn).value());
    TilePool pool(order, missing);
    EXPECT_EQ(pool.remaining(), 6);
    EXPECT_EQ(pool.take(2), (TurnRange{0, 2}));
    EXPECT_EQ(pool.take(10), (TurnRange{2, 3}));
    EXPECT_EQ(pool.take(10), (TurnRange{5, 7}));
    EXPECT_EQ(pool.remaining(), 1);
    EXPECT_EQ(pool.take(10), (TurnRange{9, 10}));
    EXPECT_EQ(pool.remaining(), 0);
    EXPECT_EQ(pool.all(), 6);
    EXPECT_EQ(pool.take(1).size(), 0);
    EXPECT_EQ(TilePool(order, TileSet(10)).take(1).size(), 0);
}

TEST(TilePool, EveryTileIsDealtOnce) {
    TileSet missing(100);
    for (std::int64_t tile = 0; tile < 100; ++tile) {
        if (tile % 7 != 3 && (tile < 40 || tile > 60)) missing.add(tile);
    }
    const DealOrder order(grid_of(10, 10), 3);
    TilePool pool(order, missing);
    TileSet dealt(100);
    while (pool.remaining() > 0) {
        const TurnRange run = pool.take(deal_size(pool.remaining(), pool.all(), 3));
        ASSERT_GT(run.size(), 0);
        for (std::int64_t turn = run.first; turn < run.end; ++turn) {
            const std::int64_t tile = order.tile(turn).value();
            EXPECT_FALSE(dealt.has(tile));
            dealt.add(tile);
        }
    }
    EXPECT_EQ(dealt, missing);
}

}  // namespace
}  // namespace peterka::parallel
