// The policy of dealing: run lengths, and a pool with holes in which no tile is lost or dealt twice.
#include "parallel/tile_pool.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace peterka::parallel {
namespace {

TEST(DealSize, NoRunIsALargePartOfTheWork) {
    EXPECT_EQ(deal_size(64'000, 64'000, 10), 100);
    EXPECT_EQ(deal_size(40'000, 64'000, 10), 100);
    EXPECT_EQ(deal_size(1000, 1000, 1000), 1);
}

TEST(DealSize, TowardsTheEndHalfOfWhatRemainsGoesOutInOneRound) {
    EXPECT_EQ(deal_size(1000, 64'000, 10), 50);
    EXPECT_EQ(deal_size(1001, 64'000, 10), 51);  // rounded up
    EXPECT_EQ(deal_size(100, 64'000, 1), 50);
}

TEST(DealSize, NeverStopsAndNeverExceedsWhatRemains) {
    EXPECT_EQ(deal_size(1, 64'000, 7), 1);
    EXPECT_EQ(deal_size(13, 64'000, 7), 1);
    EXPECT_EQ(deal_size(1, 1, 1), 1);
    EXPECT_EQ(deal_size(0, 64'000, 7), 0);
    EXPECT_EQ(deal_size(0, 0, 7), 0);
}

TEST(DealSize, MessagesStayFewHoweverManyTiles) {
    constexpr std::int64_t tiles = 1'000'000;
    constexpr int ranks = 4;
    int deals = 0;
    for (std::int64_t remaining = tiles; remaining > 0 && deals < 10'000; ++deals) {
        remaining -= deal_size(remaining, tiles, ranks);
    }
    EXPECT_GT(deals, 300);  // 64 a rank, less what the shrinking end takes over,
    EXPECT_LT(deals, 350);  // and 2P ln(tiles/(64 P)) for that end
}

TEST(AppendTile, NeighboursBecomeOneRange) {
    std::vector<TileRange> ranges;
    for (const std::int64_t tile : {0, 1, 2, 5, 6, 9}) append_tile(ranges, tile);
    EXPECT_EQ(ranges, (std::vector<TileRange>{{0, 3}, {5, 7}, {9, 10}}));
}

TEST(CellsIn, CroppedTilesCountWhatTheyHold) {
    const Tiling tiling({20, 40});  // 2 by 3 tiles; the last column has 8 cells, the upper row 4
    const std::vector<TileRange> all{{0, 6}};
    const std::vector<TileRange> some{{0, 1}, {2, 3}, {5, 6}};
    EXPECT_EQ(cells_in(all, tiling), 20 * 40);
    EXPECT_EQ(cells_in(some, tiling), 16 * 16 + 16 * 8 + 4 * 8);
    EXPECT_EQ(cells_in({}, tiling), 0);
}

TEST(TilePool, RunsEndAtHoles) {
    TilePool pool({{0, 3}, {5, 7}});
    EXPECT_EQ(pool.remaining(), 5);
    EXPECT_EQ(pool.take(2), (TileRange{0, 2}));
    EXPECT_EQ(pool.take(10), (TileRange{2, 3}));
    EXPECT_EQ(pool.take(10), (TileRange{5, 7}));
    EXPECT_EQ(pool.remaining(), 0);
    EXPECT_EQ(pool.take(1).size(), 0);
}

TEST(TilePool, EmptyRangesAreNoTiles) {
    TilePool pool({{4, 4}, {6, 7}, {9, 9}});
    EXPECT_EQ(pool.remaining(), 1);
    EXPECT_EQ(pool.take(5), (TileRange{6, 7}));
    EXPECT_EQ(pool.take(5).size(), 0);
    EXPECT_EQ(TilePool({}).take(1).size(), 0);
}

TEST(TilePool, EveryTileIsDealtOnce) {
    const std::vector<TileRange> missing{{3, 40}, {41, 42}, {60, 100}};
    TilePool pool(missing);
    std::vector<TileRange> dealt;
    while (pool.remaining() > 0) {
        const TileRange run = pool.take(deal_size(pool.remaining(), pool.all(), 3));
        ASSERT_GT(run.size(), 0);
        for (std::int64_t tile = run.first; tile < run.end; ++tile) append_tile(dealt, tile);
    }
    EXPECT_EQ(dealt, missing);
}

}  // namespace
}  // namespace peterka::parallel
