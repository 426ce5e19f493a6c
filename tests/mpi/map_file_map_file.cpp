// A map file written by several ranks: identical bytes whichever rank writes which tile, and after a resume.
#include "map_file/map_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hdf5/block.hpp"
#include "map_file/layout.hpp"
#include "parallel/collective.hpp"
#include "shared_map.hpp"

namespace peterka::map_file {
namespace {

using examples::omitted;

class OutputMapFile : public examples::SharedMap {};

INSTANTIATE_TEST_SUITE_P(Kinds, OutputMapFile, testing::Values(job::Kind::map, job::Kind::basin),
                         [](const auto& kind) { return kind.param == job::Kind::map ? "map" : "basin"; });

TEST_P(OutputMapFile, SameBytesAsByOneRankAlone) {
    MapFile map = create("together.h5");
    const RemainingTiles remaining = map.remaining_tiles();
    EXPECT_EQ(remaining.tiles, parallel::TileSet::all(tiling_.count()));
    EXPECT_EQ(remaining.damaged, 0);
    write(map, remaining.tiles);
    map.finish(map.statistics(), omitted, {ranks_, 1.0, "here"});
    map.close();
    write_alone("alone.h5");
    EXPECT_EQ(content("together.h5"), content("alone.h5"));
}

// Location of a dataset's numbers in the file [bytes].
struct Range {
    haddr_t begin = 0;
    haddr_t end = 0;
};

std::vector<Range> ranges_of_numbers(const std::filesystem::path& path, const job::Job& job) {
    const hdf5::Checked check(path);
    const hdf5::FileId file(check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
    std::vector<Range> ranges;
    for (const DatasetPlan& plan : layout(job)) {
        const hdf5::DatasetId dataset(check(H5Dopen2(file.id(), plan.path().c_str(), H5P_DEFAULT), "H5Dopen2"));
        haddr_t begin = H5Dget_offset(dataset.id());
        const hsize_t corner[] = {0, 0};
        if (plan.is_tiled()) {
            check(H5Dget_chunk_info_by_coord(dataset.id(), corner, nullptr, &begin, nullptr), "chunk info");
        }
        ranges.push_back({begin, begin + static_cast<haddr_t>(plan.bytes())});
    }
    return ranges;
}

// Kills are harmless because the file on disk changes only by numbers written in place, immediately.
TEST_P(OutputMapFile, WritingTilesChangesNothingButNumbersAtOnce) {
    MapFile map = create("map.h5");
    const std::string before = examples::content_of(folder_ / "map.h5");
    write(map, map.remaining_tiles().tiles);
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string after = examples::content_of(folder_ / "map.h5");
    const std::vector<Range> numbers = ranges_of_numbers(folder_ / "map.h5", job_);
    MPI_Barrier(MPI_COMM_WORLD);
    map.close();
    ASSERT_EQ(after.size(), before.size());
    std::int64_t changed = 0;
    std::int64_t elsewhere = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (after[i] == before[i]) continue;
        ++changed;
        if (std::ranges::none_of(numbers, [&](const Range& r) { return r.begin <= i && i < r.end; }))
            ++elsewhere;
    }
    EXPECT_GT(changed, 50 * 70 * 10) << "tiles are on their way, but not in the file";
    EXPECT_EQ(elsewhere, 0);
}

TEST_P(OutputMapFile, FinishedFileIsCompleteAndCanBeReadAgain) {
    MapFile map = create("map.h5");
    write(map, map.remaining_tiles().tiles);
    const findings::Statistics at_the_end = map.statistics();
    map.finish(at_the_end, omitted, {ranks_, 1.0, "here"});
    map.close();
    EXPECT_EQ(inspect(folder_ / "map.h5", job_), Existing::complete);
    MapFile again = open("map.h5", Access::read);
    EXPECT_TRUE(again.remaining_tiles().tiles.empty());
    const findings::Statistics later = again.statistics();
    again.close();
    EXPECT_EQ(later.counts.by_regime, at_the_end.counts.by_regime);
    EXPECT_EQ(later.periodic_cells, at_the_end.periodic_cells);
    EXPECT_EQ(later.tile_seconds, 0.5 * static_cast<double>(tiling_.count()));
}

TEST_P(OutputMapFile, StatisticsAreThoseOfAllCells) {
    findings::Statistics expected;
    for (std::int64_t i = 0; i < tiling_.count(); ++i) {
        std::vector<quantities::StoredCell> cells;
        for (const auto& cell : examples::made_up_cells(tiling_.tile(i))) {
            cells.push_back(quantities::in_file_units(cell, examples::same_scales));
        }
        findings::add_tile(expected, tiling_.tile(i), cells);
    }
    MapFile map = create("map.h5");
    write(map, map.remaining_tiles().tiles);
    const findings::Statistics found = map.statistics();
    map.close();
    EXPECT_EQ(found.counts.cells, 50 * 70);
    EXPECT_EQ(found.counts.by_regime, expected.counts.by_regime);
    EXPECT_EQ(found.counts.failed_by_status, expected.counts.failed_by_status);
    EXPECT_EQ(found.counts.cycles, expected.counts.cycles);
    EXPECT_EQ(found.periodic_cells, expected.periodic_cells);
    for (const auto& [a, b] : {std::pair{found.largest.any_regime, expected.largest.any_regime},
                               {found.largest.one_to_one, expected.largest.one_to_one}}) {
        EXPECT_TRUE(a.found());
        EXPECT_EQ(a.peak_force_ratio, b.peak_force_ratio);
        EXPECT_EQ(a.row, b.row);
        EXPECT_EQ(a.column, b.column);
    }
}

TEST_P(OutputMapFile, ResumeComputesWhatIsMissingOrDamagedAndNothingElse) {
    {
        MapFile map = create("map.h5");
        write(map, std::vector<std::int64_t>{1, 2, 3, 5, 8, 13});
        map.record({ranks_, 2.0, "first host", 1.5});
        map.close();
    }
    parallel::on_first_rank(MPI_COMM_WORLD, [&] {
        const hdf5::Checked check(folder_ / "map.h5");
        const hdf5::FileId file(
            check(H5Fopen((folder_ / "map.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "H5Fopen"));
        const hdf5::DatasetId cycles(check(H5Dopen2(file.id(), "/cycles", H5P_DEFAULT), "H5Dopen2"));
        const std::int32_t wrong = 999'999;
        hdf5::write_block(check, cycles.id(), hdf5::Number::int32,
                          hdf5::Block(parallel::Tile{0, 0, 33, {1, 1}}), &wrong);
    });
    EXPECT_EQ(inspect(folder_ / "map.h5", job_), Existing::resumable);

    MapFile map = open("map.h5");
    const RemainingTiles remaining = map.remaining_tiles();
    parallel::TileSet missing(tiling_.count());
    for (const std::int64_t tile : {0, 2, 4, 6, 7, 9, 10, 11, 12, 14, 15, 16, 17, 18, 19}) missing.add(tile);
    EXPECT_EQ(remaining.tiles, missing);
    EXPECT_EQ(remaining.damaged, 1);
    write(map, remaining.tiles);
    map.finish(map.statistics(), omitted, {ranks_, 3.0, "second host", 2.5});
    map.close();
    write_alone("alone.h5");
    EXPECT_EQ(content("map.h5"), content("alone.h5"));

    const hdf5::Checked check(folder_ / "map.h5");
    const hdf5::FileId file(
        check(H5Fopen((folder_ / "map.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
    EXPECT_EQ(hdf5::read_number(check, file.id(), path::compute_seconds), 5.0);
    EXPECT_EQ(hdf5::read_number(check, file.id(), path::solve_seconds), 4.0);
    EXPECT_EQ(hdf5::read_number(check, file.id(), path::ranks), ranks_);
}

TEST_P(OutputMapFile, PreviousMapStaysUntilTheNewOneIsFinished) {
    write_alone("map.h5");
    MPI_Barrier(MPI_COMM_WORLD);
    MapFile map = create("map.h5");
    const bool kept = std::filesystem::exists(previous_name(folder_ / "map.h5"));
    MPI_Barrier(MPI_COMM_WORLD);
    write(map, map.remaining_tiles().tiles);
    map.finish(map.statistics(), omitted, {});
    map.close();
    EXPECT_TRUE(kept);
    EXPECT_FALSE(std::filesystem::exists(previous_name(folder_ / "map.h5")));
}

TEST_P(OutputMapFile, FailureToCreateIsThrownOnAllRanks) {
    bool thrown = false;
    try {
        (void)create("no/such/folder/map.h5");
    } catch (const Failure& failure) {
        thrown = failure.code() == ExitCode::output;
    }
    EXPECT_TRUE(thrown);
}

TEST_P(OutputMapFile, FailureToOpenIsThrownOnAllRanks) {
    std::string text;
    try {
        (void)open("absent.h5");
    } catch (const Failure& failure) {
        text = failure.what();
    }
    EXPECT_NE(text.find("absent.h5: H5Fopen failed: "), std::string::npos) << text;
    EXPECT_EQ(text.find("no reason given"), std::string::npos) << text;
}

}  // namespace
}  // namespace peterka::map_file
