// Every dataset of a map file: where it lies, what it holds and how large it is.
//
// Creating, sizing and inspecting a file all follow this one list. Dimensions are HDF5 dimension scales in the
// group of the datasets they belong to, as netCDF-4 readers expect. "same bytes" holds for all groups except
// /run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hdf5/variable.hpp"
#include "job/job.hpp"
#include "parallel/tiles.hpp"

namespace peterka::map_file {

// Files of version 1 have no checksum over what lies outside the tiles. Those of version 2 have none over their
// raw bytes, and the label of a cell with status 0, then named `proved`, may depend on rounding; they can still
// be read.
inline constexpr int layout_version = cell::newest_layout;
inline constexpr int oldest_readable = 2;
inline constexpr std::int64_t attractor_capacity = 256;

// The seal (seal.hpp).
inline constexpr hdf5::Variable checksum_of_file{
    "checksum", hdf5::Number::uint64, 0, "", "XXH3 (64 bits) of all that is final in the file; written last"};

// The record of raw bytes (raw_bytes.hpp), at the end of the file.
inline constexpr hdf5::Variable record_of_bytes{"bytes", hdf5::Number::text, 0, "",
                                                "XXH3 (64 bits) of the file's bytes outside these ranges"};

struct Dimension {
    std::string name;  // of the scale, in the same group
    std::int64_t size = 0;
};

struct DatasetPlan {
    std::string group;  // "/", "/tiles", ...
    hdf5::Variable variable;
    std::vector<Dimension> dimensions;  // none for a scalar
    std::vector<std::int64_t> chunk =
        {};  // on the plane of cells: the extent of one tile, or of a smaller plane

    [[nodiscard]] std::string path() const;
    [[nodiscard]] bool is_scale() const;  // a dimension's own dataset: its coordinates
    [[nodiscard]] bool is_tiled() const { return !chunk.empty(); }
    [[nodiscard]] std::int64_t bytes() const;  // in the file; the largest std::int64_t on overflow
};

// The quantity that an axis varies, as a coordinate. Its strings live as long as the program.
[[nodiscard]] hdf5::Variable coordinate_of(std::string_view key);

// Scales come before the datasets that they belong to.
[[nodiscard]] std::vector<DatasetPlan> layout(const job::Job& job);

// A branch of a sweep is one tile; with [starts] or [uncertainty], which know no direction, all branches of a
// gap.
[[nodiscard]] parallel::Tiling tiling(const job::Job& job);

// Paths that the program itself reads or writes by name.
namespace path {
inline constexpr const char* engine = "/engine";
inline constexpr const char* done = "/tiles/done";
inline constexpr const char* checksum = "/tiles/checksum";
inline constexpr const char* tile_seconds = "/run/tile_seconds";
inline constexpr const char* tile_rank = "/run/tile_rank";
inline constexpr const char* ranks = "/run/ranks";
inline constexpr const char* compute_seconds = "/run/compute_seconds";
inline constexpr const char* solve_seconds = "/run/solve_seconds";
inline constexpr const char* hosts = "/run/hosts";
inline constexpr const char* omitted = "/summary/omitted";
inline constexpr const char* failures = "/summary/failures";
inline constexpr const char* sum_of_file = "/summary/checksum";
inline constexpr const char* sum_of_frame = "/summary/frame";
inline constexpr const char* finished = "/summary/finished";
inline constexpr const char* bytes = "/summary/bytes";
inline constexpr const char* attractor = "/attractor";
inline constexpr const char* attractor_count = "/attractors/count";
inline constexpr const char* attractor_cells = "/attractors/cells";
}  // namespace path

}  // namespace peterka::map_file
