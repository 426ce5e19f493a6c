// Tiles in a file: they are read back as written, and external modifications are detected.
#include "map_file/tile_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "hdf5/block.hpp"
#include "map_examples.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_file.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/tile_bytes.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {
namespace {

class OutputTileStore : public testing::Test {
  protected:
    OutputTileStore() {
        make_file(path_, job_, examples::made_by());
        file_ = hdf5::FileId(check_(H5Fopen(path_.c_str(), H5F_ACC_RDWR, file_access(check_).id()), "H5Fopen"));
        disk_.emplace(path_);
    }

    [[nodiscard]] TileStore store() const { return {{check_, file_.id(), *disk_}, job_}; }

    void overwrite(const char* dataset, hdf5::Number number, const hdf5::Block& block, const void* value) {
        const hdf5::DatasetId id(check_(H5Dopen2(file_.id(), dataset, H5P_DEFAULT), "H5Dopen2"));
        hdf5::write_block(check_, id.id(), number, block, value);
    }

    examples::Folder folder_;
    std::filesystem::path path_ = folder_ / "map.h5";
    job::Job job_ = examples::small_map(20, 40);  // six tiles, of which four are cropped
    hdf5::Checked check_{path_};
    hdf5::FileId file_;
    std::optional<hdf5::DiskFile> disk_;
};

TEST_F(OutputTileStore, NewFileHasNoTileAndFillsSayThatNothingIsComputed) {
    const TileStore tiles = store();
    for (std::int64_t i = 0; i < tiles.tiling().count(); ++i) {
        const parallel::Tile tile = tiles.tiling().tile(i);
        EXPECT_EQ(tiles.state(tile), TileState::missing);
        EXPECT_TRUE(std::isnan(tiles.seconds(tile)));
        for (const quantities::StoredCell& cell : tiles.read(tile)) {
            EXPECT_EQ(static_cast<int>(cell.regime), regime::regime_not_computed);
            EXPECT_EQ(static_cast<int>(cell.status), regime::regime_not_computed);
            EXPECT_EQ(cell.impacts, -1);
            EXPECT_EQ(cell.period, -1);
            EXPECT_EQ(cell.cycles, -1);
            EXPECT_TRUE(std::isnan(cell.peak_force));
            EXPECT_TRUE(std::isnan(cell.impact_rate));
        }
    }
}

// Full tiles bypass HDF5's selections, cropped ones use them.
TEST_F(OutputTileStore, Hdf5ReadsEachTileAsItWasWritten) {
    TileStore tiles = store();
    const hdf5::DatasetId forces(check_(H5Dopen2(file_.id(), "/peak_force_ratio", H5P_DEFAULT), "H5Dopen2"));
    for (std::int64_t i = 0; i < 6; ++i) {
        const parallel::Tile tile = tiles.tiling().tile(i);
        const auto written = examples::made_up_stored_cells(tile);
        tiles.write(tile, written, {});
        std::vector<double> read(written.size());
        hdf5::read_block(check_, forces.id(), hdf5::Number::float64, hdf5::Block(tile), read.data());
        for (std::size_t n = 0; n < read.size(); ++n) {
            if (std::isnan(written[n].peak_force)) continue;
            EXPECT_EQ(read[n], written[n].peak_force) << i << " " << n;
        }
    }
}

TEST_F(OutputTileStore, EachTileComesBackFromItsOwnPlace) {
    TileStore tiles = store();
    const std::vector<quantities::Field> fields = quantities::stored_fields(job_);
    for (const std::int64_t i : {5, 0, 3, 2, 4, 1}) {
        const parallel::Tile tile = tiles.tiling().tile(i);
        tiles.write(tile, examples::made_up_stored_cells(tile), {0.5 * static_cast<double>(i), 7});
    }
    for (std::int64_t i = 0; i < 6; ++i) {
        const parallel::Tile tile = tiles.tiling().tile(i);
        EXPECT_EQ(encode(fields, tiles.read(tile)), encode(fields, examples::made_up_stored_cells(tile)));
        EXPECT_EQ(tiles.state(tile), TileState::whole);
        EXPECT_EQ(tiles.seconds(tile), 0.5 * static_cast<double>(i));
    }
}

TEST_F(OutputTileStore, CellsLieAtTheirRowAndColumn) {
    TileStore tiles = store();
    for (std::int64_t i = 0; i < 6; ++i) {
        tiles.write(tiles.tiling().tile(i), examples::made_up_stored_cells(tiles.tiling().tile(i)), {});
    }
    std::vector<std::int32_t> cycles(20 * 40);
    const hdf5::DatasetId dataset(check_(H5Dopen2(file_.id(), "/cycles", H5P_DEFAULT), "H5Dopen2"));
    hdf5::read_block(check_, dataset.id(), hdf5::Number::int32, hdf5::Block(parallel::Tile{0, 0, 0, {20, 40}}),
                     cycles.data());
    for (std::int64_t row = 0; row < 20; ++row) {
        for (std::int64_t column = 0; column < 40; ++column) {
            EXPECT_EQ(cycles[static_cast<std::size_t>(row * 40 + column)],
                      examples::made_up_cell(row, column).cycles);
        }
    }
}

TEST_F(OutputTileStore, ChangedCellIsFoundInItsTileOnly) {
    TileStore tiles = store();
    for (std::int64_t i = 0; i < 6; ++i) {
        tiles.write(tiles.tiling().tile(i), examples::made_up_stored_cells(tiles.tiling().tile(i)), {});
    }
    const double wrong = 1e-300;
    overwrite("/impact_rate", hdf5::Number::float64, hdf5::Block(parallel::Tile{0, 17, 39, {1, 1}}), &wrong);
    for (std::int64_t i = 0; i < 6; ++i) {
        EXPECT_EQ(tiles.state(tiles.tiling().tile(i)), i == 5 ? TileState::damaged : TileState::whole) << i;
    }
    // every reader is notified: statistics, audit and traces
    EXPECT_THROW((void)tiles.read(tiles.tiling().tile(5)), Failure);
    EXPECT_THROW((void)tiles.read_cell({16, 33}), Failure);
    EXPECT_EQ(tiles.read_cell({15, 33}).cycles, examples::made_up_cell(15, 33).cycles);
}

TEST_F(OutputTileStore, FlippedByteOnDiskIsFound) {
    const parallel::Tile first = tiling(job_).tile(0);
    haddr_t address = HADDR_UNDEF;
    {
        TileStore tiles = store();
        tiles.write(first, examples::made_up_stored_cells(first), {});
        const hdf5::DatasetId dataset(
            check_(H5Dopen2(file_.id(), "/peak_force_ratio", H5P_DEFAULT), "H5Dopen2"));
        hsize_t size = 0;
        const hsize_t corner[] = {0, 0};
        check_(H5Dget_chunk_info_by_coord(dataset.id(), corner, nullptr, &address, &size), "chunk info");
    }
    file_ = hdf5::FileId();
    std::string content = examples::content_of(path_);
    content[address + 1000] = static_cast<char>(content[address + 1000] ^ 0x10);
    examples::write_content(path_, content);
    file_ = hdf5::FileId(check_(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
    disk_.emplace(path_);
    EXPECT_EQ(store().state(first), TileState::damaged);
}

TEST_F(OutputTileStore, DoneMarkWithoutChecksumIsNotBelieved) {
    const std::int8_t done = 1;
    overwrite(path::done, hdf5::Number::int8, hdf5::Block(2, 1), &done);
    EXPECT_EQ(store().state(tiling(job_).tile(2)), TileState::damaged);
}

}  // namespace
}  // namespace peterka::map_file
