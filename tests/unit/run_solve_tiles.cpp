// One rank's tiles: all are solved, with no more begun at a time than permitted.
#include "run/solve_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
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
    void solved(const Tile& tile) override { EXPECT_TRUE(done.insert(tile.index).second); }
    bool carry_on() override { return true; }

    std::int64_t begun = 0;
    std::int64_t most_begun = 0;
    std::set<std::int64_t> done;
};

// Largest number in progress at once; each tile is one cell, and many are chaotic and take long.
std::int64_t most_begun(std::size_t most_in_hand) {
    job::Job job = testing::job_170mm(0);
    job.columns = {2.8, 4.2, tiles, job::Spacing::linear};
    job.rows = {0.2, 0.2, 1, job::Spacing::linear};
    const scene::Scene scene(job);
    Row row;
    const TileWork work{.begin =
                            [](const Tile& tile) {
                                return std::vector<CellIndex>{{tile.row, tile.column}};
                            },
                        .go_on = [](const auto&...) { return std::vector<CellIndex>(); },
                        .most_in_hand = most_in_hand};
    solve_tiles(scene, {}, work, row);
    EXPECT_EQ(std::ssize(row.done), tiles);
    return row.most_begun;
}

TEST(SolveTiles, KeepsNoMoreInHandThanAllowed) {
    EXPECT_EQ(most_begun(1), 1);
    EXPECT_EQ(most_begun(3), 3);
    EXPECT_EQ(most_begun(std::numeric_limits<std::size_t>::max()), tiles);
}

}  // namespace
}  // namespace peterka
