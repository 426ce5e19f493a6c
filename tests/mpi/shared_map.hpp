// A map file that all ranks write, and what is in it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hdf5/block.hpp"
#include "map_file/layout.hpp"
#include "map_file/map_file.hpp"
#include "parallel/collective.hpp"
#include "shared_folder.hpp"

namespace peterka::map_file::examples {

inline constexpr scene::Scales same_scales{.force_n = 16, .weight_n = 2};
inline scene::Scales scales(std::int64_t, std::int64_t) {
    return same_scales;
}
inline const std::vector<std::string> omitted{"the cubic term: its effect is small"};

class SharedMap : public ::testing::TestWithParam<job::Kind> {
  protected:
    [[nodiscard]] MapFile create(const char* name, MPI_Comm communicator = MPI_COMM_WORLD) const {
        return MapFile::create(folder_ / name, job_, made_by(), scales, communicator);
    }
    [[nodiscard]] MapFile open(const char* name, Access access = Access::write) const {
        return MapFile::open(folder_ / name, job_, scales, MPI_COMM_WORLD, access);
    }

    // Every rank writes its tiles of `tiles`, from the last to the first.
    void write(MapFile& map, const std::vector<std::int64_t>& tiles) const {
        for (auto i = std::ssize(tiles) - 1; i >= 0; --i) {
            if (i % ranks_ != rank_) continue;
            const parallel::Tile tile = tiling_.tile(tiles[static_cast<std::size_t>(i)]);
            map.write_tile(tile, solved(made_up_cells(tile, orbits_)), 0.5);
        }
    }

    void write(MapFile& map, const parallel::TileSet& set) const {
        std::vector<std::int64_t> tiles;
        for (std::int64_t tile = 0; tile < set.tiles(); ++tile) {
            if (set.has(tile)) tiles.push_back(tile);
        }
        write(map, tiles);
    }

    // The same map by one rank alone, tile after tile.
    void write_alone(const char* name) const {
        if (rank_ != 0) return;
        MapFile map = create(name, MPI_COMM_SELF);
        for (std::int64_t i = 0; i < tiling_.count(); ++i) {
            const parallel::Tile tile = tiling_.tile(i);
            map.write_tile(tile, solved(made_up_cells(tile, orbits_)), 7.0);
        }
        map.finish(map.statistics(), omitted, {});
        map.close();
    }

    // All datasets outside /run, on rank 0; all ranks have closed the file.
    [[nodiscard]] std::map<std::string, std::string> content(const char* name) const {
        MPI_Barrier(MPI_COMM_WORLD);
        std::map<std::string, std::string> all;
        if (rank_ != 0) return all;
        const hdf5::Checked check(folder_ / name);
        const hdf5::FileId file(
            check(H5Fopen((folder_ / name).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
        for (const DatasetPlan& plan : layout(job_)) {
            if (plan.group == "/run") continue;
            const hdf5::DatasetId dataset(
                check(H5Dopen2(file.id(), plan.path().c_str(), H5P_DEFAULT), "H5Dopen2"));
            const hdf5::TypeId type(check(H5Dget_type(dataset.id()), "H5Dget_type"));
            std::string& bytes = all[plan.path()];
            bytes.resize(static_cast<std::size_t>(plan.bytes()));
            check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), "H5Dread");
        }
        return all;
    }

    template <class Value>
    [[nodiscard]] std::vector<Value> read(const char* name, const char* path, hdf5::Number number,
                                          const hdf5::Block& block, std::size_t count) const {
        const hdf5::Checked check(folder_ / name);
        const hdf5::FileId file(
            check(H5Fopen((folder_ / name).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
        const hdf5::DatasetId dataset(check(H5Dopen2(file.id(), path, H5P_DEFAULT), "H5Dopen2"));
        std::vector<Value> values(count);
        hdf5::read_block(check, dataset.id(), number, block, values.data());
        return values;
    }

    SharedFolder folder_;
    job::Job job_ = GetParam() == job::Kind::map ? small_map(50, 70) : small_basin(50, 70);
    parallel::Tiling tiling_ = tiling(job_);
    int orbits_ = 3;
    int rank_ = parallel::rank_in(MPI_COMM_WORLD);
    int ranks_ = static_cast<int>(parallel::gather<int>(std::vector{0}, MPI_COMM_WORLD).size());
};

}  // namespace peterka::map_file::examples
