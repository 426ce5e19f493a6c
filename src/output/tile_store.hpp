// The tiles inside an open map file: writing, reading back and vouching for them. Every call is this rank's
// own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "job/job.hpp"
#include "output/block.hpp"
#include "output/fields.hpp"
#include "output/stored.hpp"
#include "parallel/tiles.hpp"

namespace peterka::output {

enum class TileState {
    missing,  // not marked done
    whole,    // marked done, and its bytes have the checksum stored with them
    damaged,  // marked done, but the checksum differs
};

// Who computed a tile, in what time.
struct TileOrigin {
    double seconds = 0;
    std::int32_t rank = 0;
};

class TileStore {
  public:
    TileStore(const OpenMap& map, const job::Job& job);

    // Of a sweep with its samples (samples.hpp). First the cells, then their checksum, then the done mark: a
    // kill in between leaves no mark that lies.
    void write(const parallel::Tile& tile, std::span<const StoredCell> cells, const TileOrigin& origin,
               std::span<const double> samples = {});
    // A tile marked done is given with its checksum or not at all: throws Failure(ExitCode::output). Others as
    // they are.
    [[nodiscard]] std::vector<StoredCell> read(const parallel::Tile& tile) const;
    // One cell, with its whole tile's checksum.
    [[nodiscard]] StoredCell read_cell(const parallel::Place& cell) const;
    [[nodiscard]] TileState state(const parallel::Tile& tile) const;
    [[nodiscard]] double seconds(const parallel::Tile& tile) const;  // NaN for a tile that was never written

    [[nodiscard]] const parallel::Tiling& tiling() const { return tiling_; }

  private:
    void write_whole(const parallel::Tile& tile, std::span<const std::byte> bytes, const TileOrigin& origin);
    // A part of a tile's bytes, and the dataset and block in which it lies.
    struct Part {
        const Stored& stored;
        Block block;
        std::size_t bytes;
    };
    [[nodiscard]] std::vector<Part> parts(const parallel::Tile& tile) const;
    [[nodiscard]] std::vector<std::byte> read_bytes(const parallel::Tile& tile) const;
    [[nodiscard]] bool is_done(const parallel::Tile& tile) const;
    // Whether a tile's bytes have the checksum stored with it.
    [[nodiscard]] bool fits(const parallel::Tile& tile, std::span<const std::byte> bytes) const;

    OpenMap map_;
    parallel::Tiling tiling_;
    std::vector<Field> fields_;
    std::int64_t samples_;          // of a sweep, per cell and variable
    std::vector<Stored> datasets_;  // one per field and one per variable that is sampled
    Stored checksum_;
    Stored done_;
    Stored seconds_;
    Stored rank_;
};

}  // namespace peterka::output
