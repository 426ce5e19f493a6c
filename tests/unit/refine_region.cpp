// Refining synthetic maps: what is computed, what is filled, and independence of the division into regions.
#include "refine/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "map_examples.hpp"
#include "map_file/tile_bytes.hpp"
#include "quantities/fields.hpp"
#include "refine/regions.hpp"

namespace peterka::refine {
namespace {

using regime::CellResult;
using regime::Regime;
using CellAt = std::function<CellResult(std::int64_t, std::int64_t)>;

job::Job refined(std::int64_t rows, std::int64_t columns, std::int64_t levels) {
    job::Job job = map_file::examples::small_map(rows, columns);
    job.refine.levels = levels;
    return job;
}

CellResult orbit(double force, std::int32_t impacts = 1) {
    return {.regime = Regime::periodic,
            .impacts = impacts,
            .period = 1,
            .cycles = 30,
            .peak_force = force,
            .impact_rate = static_cast<double>(impacts)};
}

CellResult gentle(std::int64_t row, std::int64_t column) {
    const auto x = static_cast<double>(column);
    const auto y = static_cast<double>(row);
    return orbit(50 + 0.3 * x - 0.2 * y + 1e-4 * x * x + 1e-6 * x * y * y);
}

// A disc of another z, a patch of chaos with a hole in it, and a jump of the force.
CellResult patchwork(std::int64_t row, std::int64_t column) {
    if (std::hypot(row - 30, column - 33) < 14) return orbit(20 + static_cast<double>(row), 2);
    if (row > 60 && column > 20) {
        if ((row * 7 + column * 13) % 41 == 0) return orbit(3, 5);
        return {.regime = Regime::chaotic, .cycles = 1000, .peak_force = static_cast<double>(row % 7)};
    }
    CellResult cell = gentle(row, column);
    if (column > 70) cell.peak_force *= 1.5;
    return cell;
}

std::vector<CellResult> refine_all(const job::Job& job, const CellAt& cell_at, const parallel::Tile& rectangle,
                                   std::size_t& computed) {
    Region region(job, rectangle);
    for (auto places = region.next(); !places.empty(); places = region.next()) {
        std::vector<attractors::SolvedCell> results;
        for (const parallel::CellIndex& place : places)
            results.push_back({cell_at(place.row, place.column), {}});
        region.put(results);
        computed += places.size();
    }
    std::vector<CellResult> cells;
    for (const attractors::SolvedCell& solved : region.cells(rectangle)) cells.push_back(solved.cell);
    return cells;
}

parallel::Tile whole(const job::Job& job) {
    return {0, 0, 0, {job.rows.points, job.columns.points}};
}

std::vector<CellResult> refine_all(const job::Job& job, const CellAt& cell_at) {
    std::size_t computed = 0;
    return refine_all(job, cell_at, whole(job), computed);
}

TEST(RefineRegion, ASmoothMapNeedsItsCoarsestLatticeOnly) {
    const job::Job job = refined(65, 100, 3);
    std::size_t computed = 0;
    const auto cells = refine_all(job, gentle, whole(job), computed);
    EXPECT_EQ(computed, 9U * 14U);
    for (std::int64_t row = 0; row < 65; ++row) {
        for (std::int64_t column = 0; column < 100; ++column) {
            const CellResult& cell = cells[static_cast<std::size_t>(row * 100 + column)];
            EXPECT_NEAR(cell.peak_force, gentle(row, column).peak_force, 1e-10);
            const bool on_lattice = (row % 8 == 0 || row == 64) && (column % 8 == 0 || column == 99);
            EXPECT_EQ(cell.computed, on_lattice) << row << " " << column;
        }
    }
}

TEST(RefineRegion, ComputedCellsAreWhatWasComputed) {
    const job::Job job = refined(97, 91, 3);
    const auto cells = refine_all(job, patchwork);
    std::size_t computed = 0;
    for (std::int64_t row = 0; row < 97; ++row) {
        for (std::int64_t column = 0; column < 91; ++column) {
            const CellResult& cell = cells[static_cast<std::size_t>(row * 91 + column)];
            if (!cell.computed) continue;
            ++computed;
            EXPECT_EQ(cell.peak_force, patchwork(row, column).peak_force);
            EXPECT_EQ(cell.impacts, patchwork(row, column).impacts);
        }
    }
    EXPECT_GT(computed, 97U * 91U / 8);
    EXPECT_LT(computed, 97U * 91U);
}

TEST(RefineRegion, EdgesOfARegimeAreExact) {
    const job::Job job = refined(97, 91, 3);
    const auto cells = refine_all(job, patchwork);
    for (std::int64_t row = 0; row < 60; ++row) {
        for (std::int64_t column = 0; column < 91; ++column) {
            const CellResult& cell = cells[static_cast<std::size_t>(row * 91 + column)];
            EXPECT_EQ(cell.impacts, patchwork(row, column).impacts) << row << " " << column;
            EXPECT_NEAR(cell.peak_force, patchwork(row, column).peak_force, 0.01 * cell.peak_force);
        }
    }
}

std::vector<std::byte> bytes_of(const std::vector<quantities::Field>& fields,
                                const std::vector<CellResult>& cells) {
    std::vector<quantities::StoredCell> stored;
    for (const CellResult& cell : cells) stored.push_back(quantities::in_file_units(cell, {}));
    return map_file::encode(fields, stored);
}

TEST(RefineRegion, NoCutOfTheMapShows) {
    const job::Job job = refined(97, 91, 3);
    const auto fields = quantities::stored_fields(job);
    const auto expected = bytes_of(fields, refine_all(job, patchwork));
    for (const std::int64_t side : {16, 32, 64}) {
        const parallel::Tiling regions({97, 91}, {side, side});
        std::vector<CellResult> cells(97 * 91);
        std::size_t computed = 0;
        for (std::int64_t index = 0; index < regions.count(); ++index) {
            const parallel::Tile part = regions.tile(index);
            const auto own = refine_all(job, patchwork, part, computed);
            for (std::int64_t i = 0; i < part.size(); ++i) {
                const std::int64_t row = part.row + i / part.extent.columns;
                const std::int64_t column = part.column + i % part.extent.columns;
                cells[static_cast<std::size_t>(row * 91 + column)] = own[static_cast<std::size_t>(i)];
            }
        }
        EXPECT_EQ(bytes_of(fields, cells), expected) << side;
    }
}

TEST(RefineRegion, NothingIsFilledWithoutLevels) {
    const job::Job job = refined(20, 20, 0);
    std::size_t computed = 0;
    const auto cells = refine_all(job, gentle, whole(job), computed);
    EXPECT_EQ(computed, 400U);
}

TEST(RefineRegion, MapsSmallerThanAStrideAreRefinedToo) {
    for (const std::int64_t points : {2, 3, 5}) {
        const job::Job job = refined(points, 40, 6);
        const auto cells = refine_all(job, gentle);
        for (const CellResult& cell : cells) EXPECT_EQ(cell.regime, Regime::periodic);
    }
}

TEST(RefineRegions, LargeWhereThatLeavesEnoughForAllRanks) {
    EXPECT_EQ(regions_of({4097, 4097}, 2).tile(0).extent, (parallel::Extent{128, 128}));
    EXPECT_EQ(regions_of({4097, 4097}, 100).tile(0).extent, (parallel::Extent{64, 64}));
    EXPECT_EQ(regions_of({4097, 4097}, 100000).tile(0).extent, (parallel::Extent{32, 32}));
}

TEST(RefineRegions, MissingTilesNameTheirRegions) {
    const parallel::Tiling tiles({100, 100});              // 7 by 7
    const parallel::Tiling regions({100, 100}, {32, 32});  // 4 by 4
    parallel::TileSet missing(tiles.count());
    for (const std::int64_t tile : {0, 1, 2, 48}) missing.add(tile);
    parallel::TileSet wanted(regions.count());
    for (const std::int64_t region : {0, 1, 15}) wanted.add(region);
    EXPECT_EQ(regions_with(missing, tiles, regions), wanted);
    EXPECT_TRUE(regions_with(parallel::TileSet(tiles.count()), tiles, regions).empty());
}

TEST(RefineRegions, EveryTileIsInOneRegion) {
    const parallel::Tiling tiles({100, 70});
    const parallel::Tiling regions({100, 70}, {32, 32});
    std::multiset<std::int64_t> seen;
    for (std::int64_t i = 0; i < regions.count(); ++i) {
        for (const parallel::Tile& tile : tiles_in(regions.tile(i), tiles)) {
            seen.insert(tile.index);
            EXPECT_EQ(tile.size(), tiles.tile(tile.index).size());
        }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(tiles.count()));
    EXPECT_EQ(std::set<std::int64_t>(seen.begin(), seen.end()).size(), seen.size());
}

// Each cell with its attractors, where the job keeps any.
TEST(Region, AttractorsTakeMemory) {
    job::Job job = refined(17, 17, 2);
    const parallel::Tile rectangle{.extent = {17, 17}};
    const std::int64_t alone = Region::bytes(job, rectangle);
    job.starts.attractors = 5;
    EXPECT_EQ(Region::bytes(job, rectangle), alone);
    job.starts.count = 20;
    const std::int64_t five = Region::bytes(job, rectangle);
    job.starts.attractors = 10;
    EXPECT_GT(five, alone);
    EXPECT_EQ(Region::bytes(job, rectangle) - five, five - alone);
}

}  // namespace
}  // namespace peterka::refine
