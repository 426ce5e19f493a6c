// The policy of dealing: its order, run lengths, and a pool with holes in which no tile is lost or dealt twice.
#include "parallel/tile_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
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

std::vector<std::int64_t> first_turns(const Tiling& tiling, std::int64_t turns) {
    const DealOrder order(tiling);
    std::vector<std::int64_t> first;
    for (std::int64_t turn = 0; turn < turns; ++turn) first.push_back(order.tile(turn));
    return first;
}

TEST(DealOrder, EveryTileHasOneTurn) {
    for (const auto& [rows, columns] : std::vector<std::pair<std::int64_t, std::int64_t>>{
             {1, 1}, {1, 2}, {2, 1}, {3, 1}, {2, 2}, {1, 30}, {64, 64}, {997, 1}, {30, 1001}}) {
        const Tiling tiling = grid_of(rows, columns);
        std::vector<std::int64_t> dealt = first_turns(tiling, tiling.count());
        std::ranges::sort(dealt);
        for (std::int64_t tile = 0; tile < tiling.count(); ++tile) {
            ASSERT_EQ(dealt[static_cast<std::size_t>(tile)], tile) << rows << " by " << columns;
        }
    }
}

TEST(DealOrder, FewTurnsReachAllPartsOfThePlane) {
    for (const std::int64_t side : {20, 64, 99, 128, 232, 376, 454}) {
        const DealOrder order(grid_of(side, side));
        for (const std::int64_t begin : {std::int64_t{0}, side * side / 2}) {
            std::set<std::int64_t> blocks;  // of 4 by 4
            for (std::int64_t turn = begin; turn < begin + 64; ++turn) {
                const std::int64_t tile = order.tile(turn);
                blocks.insert(tile / side * 4 / side * 4 + tile % side * 4 / side);
            }
            EXPECT_EQ(blocks.size(), 16U) << side << ", from turn " << begin;
        }
    }
}

TEST(DealOrder, IsKnown) {  // the replay in postprocess/ deals in the same order
    EXPECT_EQ(first_turns(grid_of(64, 64), 4), (std::vector<std::int64_t>{0, 3111, 2126, 1141}));
    EXPECT_EQ(first_turns(grid_of(5, 6), 4), (std::vector<std::int64_t>{0, 17, 4, 21}));
}

TEST(DealOrder, ManyTilesDontOverflow) {
    constexpr std::int64_t side = 1 << 27;  // of the longest axes that a job may have
    const DealOrder order(grid_of(side, side - 1));
    const std::int64_t tiles = order.tiles();
    for (const std::int64_t turn : {std::int64_t{1}, tiles / 3, tiles / 2, tiles - 2}) {
        EXPECT_GT(order.tile(turn), 0);
        EXPECT_EQ((order.tile(turn + 1) - order.tile(turn) + tiles) % tiles, order.tile(1)) << turn;
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
    EXPECT_GT(deals, 120);  // 16 a rank, less what the shrinking end takes over,
    EXPECT_LT(deals, 150);  // and 2P ln(tiles/(16 P)) for that end
}

TEST(CellsIn, CroppedTilesCountWhatTheyHold) {
    const Tiling tiling({20, 40});  // 2 by 3 tiles; the last column has 8 cells, the upper row 4
    EXPECT_EQ(cells_in(TileSet::all(6), tiling), 20 * 40);
    EXPECT_EQ(cells_in(set_of(6, {0, 2, 5}), tiling), 16 * 16 + 16 * 8 + 4 * 8);
    EXPECT_EQ(cells_in(TileSet(6), tiling), 0);
}

TEST(TilePool, RunsEndAtHoles) {
    const DealOrder order(grid_of(2, 5));
    TileSet missing(10);
    for (const std::int64_t turn : {0, 1, 2, 5, 6, 9}) missing.add(order.tile(turn));
    TilePool pool(order, missing);
    EXPECT_EQ(pool.remaining(), 6);
    EXPECT_EQ(pool.take(2), (Turns{0, 2}));
    EXPECT_EQ(pool.take(10), (Turns{2, 3}));
    EXPECT_EQ(pool.take(10), (Turns{5, 7}));
    EXPECT_EQ(pool.remaining(), 1);
    EXPECT_EQ(pool.take(10), (Turns{9, 10}));
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
    const DealOrder order(grid_of(10, 10));
    TilePool pool(order, missing);
    TileSet dealt(100);
    while (pool.remaining() > 0) {
        const Turns run = pool.take(deal_size(pool.remaining(), pool.all(), 3));
        ASSERT_GT(run.size(), 0);
        for (std::int64_t turn = run.first; turn < run.end; ++turn) {
            EXPECT_FALSE(dealt.has(order.tile(turn)));
            dealt.add(order.tile(turn));
        }
    }
    EXPECT_EQ(dealt, missing);
}

}  // namespace
}  // namespace peterka::parallel
