// What is told of a whole map: on any number of ranks the same as its cells, added up here one after the other.
#include "map_file/survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "findings/statistics.hpp"
#include "map_file/cell_attractors.hpp"
#include "shared_map.hpp"

namespace peterka::map_file {
namespace {

using attractors::SolvedCell;

constexpr std::int64_t attractors_kept = 3;

// A cell of each kind that a summary tells of; numbers are extreme somewhere in the middle of the map.
SolvedCell surveyed_cell(std::int64_t row, std::int64_t column) {
    SolvedCell solved{examples::made_up_cell(row, column), {}};
    cell::CellResult& cell = solved.cell;
    const std::int64_t number = row * 11 + column * 7 + row * column / 5;  // unlike that of the regime
    cell.last_impact = static_cast<std::int32_t>(number % 300);
    if (cell.regime == cell::Regime::chaotic)
        cell.observed_cycles = static_cast<std::int32_t>(300 + number % 700);
    if (cell.regime == cell::Regime::unresolved && number % 3 == 0) {
        cell.status = cell::Status::chaotic_so_far;
        cell.impact_rate = 0.1 + 0.001 * static_cast<double>((number * 37) % 500);
    }
    if (cell.regime == cell::Regime::periodic) {
        cell.elasticities.fill(0.01 * static_cast<double>(number % 40));
        cell.certified = cell::Certified::orbit;
        cell.force_lower = 8 * cell.peak_force - 0.5 * static_cast<double>(number % 2);
        cell.force_upper = 8 * cell.peak_force * (1 + 1e-6 * static_cast<double>(number % 5 - 2));
    }
    for (std::int64_t n = 0; n <= number % attractors_kept; ++n) {
        const bool dies = n == 2;
        solved.attractors.push_back(
            {.regime = dies     ? cell::Regime::chaotic
                       : n == 1 ? cell::Regime::no_impact
                                : cell::Regime::periodic,
             .status = cell::Status::verified,
             .impacts = n == 0 ? 1 : 0,
             .period = dies ? 0 : static_cast<std::int32_t>(1 + number % 2),
             .share = 0.5 / static_cast<double>(n + 1),
             .mean_life = dies ? 100.0 + static_cast<double>((number * 13) % 1000) : cell::unknown,
             .mean_life_error = dies ? 1.0 : cell::unknown});
    }
    cell.attractors = static_cast<std::int32_t>(number % 5 + 1);
    cell.start_attractor = static_cast<std::int32_t>(number % 4 - 1);
    const double probability = number % 2 == 0 ? 0.97 : 0.6;
    solved.outcomes = {{.regime = number % 3 == 0 ? cell::Regime::no_impact : cell::Regime::periodic,
                        .impacts = number % 3 == 0 ? 0 : 1,
                        .period = 1,
                        .probability = probability}};
    cell.outcomes = 1 + static_cast<std::int32_t>(number % 12);
    return solved;
}

class Survey : public examples::SharedMap {
  protected:
    Survey() {
        job_.output.fields = {job::OptionalField::last_impact, job::OptionalField::force_elasticity};
        std::ranges::sort(job_.output.fields);
        job_.starts.count = 8;
        job_.starts.attractors = attractors_kept;
        job_.uncertainty.rigs = 16;
        job_.certificate.cells = job_.cells();
        tiling_ = tiling(job_);
    }

    [[nodiscard]] static std::vector<SolvedCell> cells_of(const parallel::Tile& tile) {
        std::vector<SolvedCell> cells;
        for (std::int64_t i = 0; i < tile.size(); ++i) {
            cells.push_back(
                surveyed_cell(tile.row + i / tile.extent.columns, tile.column + i % tile.extent.columns));
        }
        return cells;
    }

    [[nodiscard]] findings::Statistics added_up() const {
        findings::Statistics all;
        for (std::int64_t index = 0; index < tiling_.count(); ++index) {
            const parallel::Tile tile = tiling_.tile(index);
            const std::vector<SolvedCell> cells = cells_of(tile);
            const std::vector<scene::Scales> scales(cells.size(), examples::same_scales);
            std::vector<quantities::StoredCell> stored;
            for (const SolvedCell& each : cells)
                stored.push_back(quantities::in_file_units(each.cell, examples::same_scales));
            findings::add_tile(all, tile, stored);
            findings::add_attractors(all.starts, tile, stored,
                                     stored_attractors(cells, attractors_kept, scales));
            findings::add_elasticities(all.elasticities, job_, tile, stored);
            findings::add_outcomes(all.outcomes, stored, stored_outcomes(cells, scales));
            all.tile_seconds += 0.25 * static_cast<double>(index);
        }
        return all;
    }
};

INSTANTIATE_TEST_SUITE_P(OfAMap, Survey, testing::Values(job::Kind::map));

// Their members are numbers of eight bytes.
template <class Sums>
bool alike(const Sums& a, const Sums& b) {
    static_assert(std::is_trivially_copyable_v<Sums>);
    return std::memcmp(&a, &b, sizeof(Sums)) == 0;
}

TEST_P(Survey, IsTheSumOverAllCells) {
    MapFile map = create("map.h5");
    for (std::int64_t index = tiling_.count() - 1; index >= 0; --index) {
        if (index % ranks_ != rank_) continue;
        const parallel::Tile tile = tiling_.tile(index);
        map.write_tile(tile, cells_of(tile), 0.25 * static_cast<double>(index));
    }
    const findings::Statistics found = map.statistics();
    const findings::Statistics expected = added_up();
    map.close();
    ASSERT_GT(tiling_.count(), 4);

    EXPECT_TRUE(alike(found.counts, expected.counts));
    EXPECT_TRUE(alike(found.proofs, expected.proofs));
    EXPECT_TRUE(alike(found.chaos, expected.chaos));
    EXPECT_TRUE(alike(found.longest, expected.longest));
    EXPECT_TRUE(alike(found.largest, expected.largest));
    EXPECT_TRUE(alike(found.transients, expected.transients));
    EXPECT_TRUE(alike(found.starts.counts, expected.starts.counts));
    EXPECT_TRUE(alike(found.outcomes.counts, expected.outcomes.counts));
    EXPECT_EQ(found.starts.pairs, expected.starts.pairs);
    EXPECT_EQ(found.outcomes.by_likely, expected.outcomes.by_likely);
    EXPECT_EQ(found.elasticities, expected.elasticities);
    EXPECT_EQ(found.periodic_cells, expected.periodic_cells);
    EXPECT_EQ(found.tile_seconds, expected.tile_seconds);

    // nothing that is compared is empty
    EXPECT_EQ(expected.counts.cells, job_.cells());
    EXPECT_GT(expected.proofs.furthest_outside, 0);
    EXPECT_LT(expected.chaos.fewest, expected.chaos.most);
    EXPECT_TRUE(expected.longest.found() && expected.largest.one_to_one.found());
    EXPECT_GT(expected.transients.ended, 0);
    EXPECT_TRUE(expected.starts.counts.shortest.found());
    EXPECT_GT(expected.outcomes.counts.open, 0);
    EXPECT_GT(expected.elasticities.size(), 100U);
    EXPECT_GT(std::min({expected.starts.pairs.size(), expected.outcomes.by_likely.size(),
                        expected.periodic_cells.size()}),
              1U);
}

}  // namespace
}  // namespace peterka::map_file
