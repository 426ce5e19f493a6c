// One rank's tiles: all are solved, with no more begun at a time than permitted.
#include "run/solve_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "rig.hpp"
#include "scene/scene.hpp"

namespace peterka {
namespace {

using parallel::CellIndex;
using parallel::Tile;

constexpr std::int64_t tiles = 40;

// Deals tiles 0, 1, ... of a row on each request.
class Row : public parallel::TileSource {
  public:
    std::optional<Tile> next() override {
        if (ended()) return std::nullopt;
        most_begun = std::max(most_begun, ++begun - std::ssize(done));
        const std::int64_t index = begun - 1;
        return Tile{index, 0, index, {1, 1}};
    }
    [[nodiscard]] bool ended() const override { return begun == tiles; }
    void solved(const Tile& tile) override {
        EXPECT_TRUE(done.insert(tile.index).second);
        most_unasked = std::max(most_unasked, ++unasked);
    }
    bool carry_on() override {
        unasked = 0;
        return std::ssize(done) < stop_at;
    }

    std::int64_t begun = 0;
    std::int64_t most_begun = 0;
    std::set<std::int64_t> done;
    std::int64_t unasked = 0;  // solved since it was last asked whether to go on
    std::int64_t most_unasked = 0;
    std::int64_t stop_at = std::numeric_limits<std::int64_t>::max();
};

void solve(const job::Job& job, std::size_t most_in_hand, Row& row) {
    const scene::Scene scene(job);
    const TileWork work{.begin =
                            [](const Tile& tile) {
                                return std::vector<CellIndex>{{tile.row, tile.column}};
                            },
                        .go_on = [](const auto&...) { return std::vector<CellIndex>(); },
                        .most_in_hand = most_in_hand};
    solve_tiles(scene, {}, work, row);
}

// Largest number in progress at once; each tile is one cell, and many are chaotic and take long.
std::int64_t most_begun(std::size_t most_in_hand) {
    job::Job job = testing::job_170mm(0);
    job.columns = {2.8, 4.2, tiles, job::Spacing::linear};
    job.rows = {0.2, 0.2, 1, job::Spacing::linear};
    Row row;
    solve(job, most_in_hand, row);
    EXPECT_EQ(std::ssize(row.done), tiles);
    return row.most_begun;
}

TEST(SolveTiles, KeepsNoMoreInHandThanAllowed) {
    EXPECT_EQ(most_begun(1), 1);
    EXPECT_EQ(most_begun(3), 3);
    EXPECT_EQ(most_begun(std::numeric_limits<std::size_t>::max()), tiles);
}

// Cells without impact end many at a time; other ranks wait for this one to answer meanwhile.
TEST(SolveTiles, AsksWhetherToGoOnBeforeTheLivesOfEachCell) {
    job::Job job = testing::job_170mm(0);
    job.columns = {2.8, 4.2, tiles, job::Spacing::linear};
    job.rows = {5, 5, 1, job::Spacing::linear};
    const auto solved = [&](std::int64_t stop_at) {
        Row row;
        row.stop_at = stop_at;
        solve(job, std::numeric_limits<std::size_t>::max(), row);
        return std::pair(row.most_unasked, std::ssize(row.done));
    };
    EXPECT_GT(solved(2 * tiles).first, 1);
    job.noise.acceleration_m_s2_per_sqrt_hz = 0.01;
    job.noise.cycles = 1000;
    EXPECT_EQ(solved(2 * tiles).first, 1);
    EXPECT_EQ(solved(5).second, 5);
}

}  // namespace
}  // namespace peterka
