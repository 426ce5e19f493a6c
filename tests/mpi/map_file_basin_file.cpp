// The attractor table of a basin file written by several ranks.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hdf5/block.hpp"
#include "map_file/layout.hpp"
#include "shared_map.hpp"

namespace peterka::map_file {
namespace {

using examples::omitted;

class OutputBasinFile : public examples::SharedMap {};
INSTANTIATE_TEST_SUITE_P(Basins, OutputBasinFile, testing::Values(job::Kind::basin));

TEST_P(OutputBasinFile, EveryCellFindsItsRow) {
    orbits_ = 5;
    MapFile map = create("basin.h5");
    write(map, map.remaining_tiles().tiles);
    map.finish(map.statistics(), omitted, {});
    map.close();
    // no_impact, five orbits (z = 1/1 before 2/1), chaotic, sustained_contact.
    const hdf5::Block rows(0, 8);
    EXPECT_EQ(read<std::int8_t>("basin.h5", "/attractors/regime", hdf5::Number::int8, rows, 8),
              (std::vector<std::int8_t>{0, 1, 1, 1, 1, 1, 2, 3}));
    EXPECT_EQ(read<std::int32_t>("basin.h5", "/attractors/impacts", hdf5::Number::int32, rows, 8),
              (std::vector<std::int32_t>{0, 1, 1, 1, 2, 2, 0, 0}));
    const auto orbit =
        read<double>("basin.h5", "/attractors/orbit_displacement", hdf5::Number::float64, rows, 8);
    const auto row = read<std::int32_t>("basin.h5", path::attractor, hdf5::Number::int32,
                                        hdf5::Block(parallel::Tile{0, 0, 0, {50, 70}}), 50 * 70);
    std::vector<std::int64_t> cells(8);
    for (std::int64_t i = 0; i < 50 * 70; ++i) {
        const regime::CellResult cell = examples::made_up_cell(i / 70, i % 70, orbits_);
        const std::int32_t found = row[static_cast<std::size_t>(i)];
        if (cell.regime == regime::Regime::unresolved || cell.regime == regime::Regime::failed) {
            EXPECT_EQ(found, -1);
            continue;
        }
        ASSERT_GE(found, 0);
        ASSERT_LT(found, 8);
        ++cells[static_cast<std::size_t>(found)];
        if (cell.regime == regime::Regime::periodic) {
            EXPECT_EQ(orbit[static_cast<std::size_t>(found)], cell.orbit_displacement);
        }
    }
    EXPECT_EQ(read<std::int64_t>("basin.h5", path::attractor_cells, hdf5::Number::int64, rows, 8), cells);
}

TEST_P(OutputBasinFile, MoreAttractorsThanTheTableHolds) {
    orbits_ = 400;  // of which one periodic cell in every six of 3500 has the largest number
    MapFile map = create("basin.h5");
    write(map, map.remaining_tiles().tiles);
    map.finish(map.statistics(), omitted, {});
    map.close();
    write_alone("alone.h5");
    const auto all = content("basin.h5");
    EXPECT_EQ(all, content("alone.h5"));
    if (rank_ != 0) return;
    EXPECT_NE(all.at(path::failures).find(" cells lead to attractors beyond the 256 that the table holds"),
              std::string::npos);
    EXPECT_EQ((read<std::int64_t>("basin.h5", path::attractor_cells, hdf5::Number::int64, hdf5::Block(255, 1),
                                  1)[0] > 0),
              true);
}

}  // namespace
}  // namespace peterka::map_file
