// The policy of dealing: its order, run lengths, and a pool with holes in which no tile is lost or dealt twice.
#include "parallel/tile_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "parallel/deal_order.hpp"

namespace peterka::parallel {
namespace {

TileSet set_of(std::int64_t tiles, const std::vector<std::int64_t>& some) {
    TileSet set(tiles);
    for (const std::int64_t tile : some) set.add(tile);
    return set;
}

std::vector<std::int64_t> first_turns(std::int64_t tiles, std::int64_t turns) {
    const DealOrder order(tiles);
    std::vector<std::int64_t> first;
    for (std::int64_t turn = 0; turn < turns; ++turn) first.push_back(order.tile(turn));
    return first;
}

TEST(DealOrder, EveryTileHasOneTurn) {
    for (const std::int64_t tiles : {1, 2, 3, 4, 6, 30, 64, 997, 4096, 30030}) {
        std::vector<std::int64_t> dealt = first_turns(tiles, tiles);
        std::ranges::sort(dealt);
        for (std::int64_t tile = 0; tile < tiles; ++tile)
            ASSERT_EQ(dealt[static_cast<std::size_t>(tile)], tile);
    }
}

TEST(DealOrder, FewTurnsReachAllPartsOfTheGrid) {
    constexpr std::int64_t tiles = 4096;
    for (const std::int64_t turns : {16, 100}) {
        std::vector<std::int64_t> dealt = first_turns(tiles, turns);
        std::ranges::sort(dealt);
        dealt.push_back(tiles);
        for (std::size_t i = 1; i < dealt.size(); ++i) EXPECT_LT(dealt[i] - dealt[i - 1], 3 * tiles / turns);
    }
}

TEST(DealOrder, IsKnown) {  // the replay in postprocess/ deals in the same order
    EXPECT_EQ(first_turns(4096, 4), (std::vector<std::int64_t>{0, 2531, 966, 3497}));
    EXPECT_EQ(first_turns(30, 4), (std::vector<std::int64_t>{0, 19, 8, 27}));
}

TEST(DealOrder, ManyTilesDontOverflow) {
    constexpr std::int64_t tiles =
        (std::int64_t{1} << 27) * ((std::int64_t{1} << 27) - 1);  // of the largest axes
    const DealOrder order(tiles);
    EXPECT_EQ(order.tile(0), 0);
    for (const std::int64_t turn : {std::int64_t{1}, tiles / 2, tiles - 1}) {
        EXPECT_GT(order.tile(turn), 0);
        EXPECT_LT(order.tile(turn), tiles);
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
    const DealOrder order(10);
    TileSet missing(10);
    for (const std::int64_t turn : {0, 1, 2, 5, 6, 9}) missing.add(order.tile(turn));
    TilePool pool(missing);
    EXPECT_EQ(pool.remaining(), 6);
    EXPECT_EQ(pool.take(2), (Turns{0, 2}));
    EXPECT_EQ(pool.take(10), (Turns{2, 3}));
    EXPECT_EQ(pool.take(10), (Turns{5, 7}));
    EXPECT_EQ(pool.take(10), (Turns{9, 10}));
    EXPECT_EQ(pool.remaining(), 0);
    EXPECT_EQ(pool.take(1).size(), 0);
    EXPECT_EQ(TilePool(TileSet(10)).take(1).size(), 0);
    EXPECT_EQ(TilePool(TileSet(0)).take(1).size(), 0);
}

TEST(TilePool, EveryTileIsDealtOnce) {
    TileSet missing(100);
    for (std::int64_t tile = 0; tile < 100; ++tile) {
        if (tile % 7 != 3 && (tile < 40 || tile > 60)) missing.add(tile);
    }
    TilePool pool(missing);
    const DealOrder order(100);
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
