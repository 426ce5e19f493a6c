// The tiles inside an open map file: writing, reading back and verifying them. No call is collective.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hdf5/block.hpp"
#include "hdf5/stored.hpp"
#include "job/job.hpp"
#include "map_file/cell_attractors.hpp"
#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"

namespace peterka::map_file {

enum class TileState {
    missing,  // not marked done
    whole,    // marked done, and its bytes have the checksum stored with them
    damaged,  // marked done, but the checksum differs
};

// Which rank computed a tile, and in what time.
struct TileOrigin {
    double seconds = 0;
    std::int32_t rank = 0;
};

class TileStore {
  public:
    TileStore(const hdf5::OpenMap& map, const job::Job& job);

    // `several`: the bytes of what each cell has several of: with [starts] its attractors, with [uncertainty]
    // its outcomes (cell_attractors.hpp), then, in a sweep, its samples (samples.hpp). First the cells are
    // written, then their checksum, then the done mark: a kill in between leaves no false mark.
    void write(const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
               const TileOrigin& origin, std::span<const std::byte> several = {});
    // Rewrites a finished tile, keeping its origin: its done mark is cleared until it is complete again.
    void write_again(const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
                     std::span<const std::byte> several);
    // Throws Failure(ExitCode::output) if a tile marked done does not match its checksum. Others are returned
    // as they are.
    [[nodiscard]] std::vector<quantities::StoredCell> read(const parallel::Tile& tile) const;
    // Slot after slot, cell by cell; none without [starts].
    [[nodiscard]] std::vector<quantities::StoredAttractor> read_attractors(const parallel::Tile& tile) const;
    // The same of outcomes; none without [uncertainty].
    [[nodiscard]] std::vector<quantities::StoredOutcome> read_outcomes(const parallel::Tile& tile) const;
    // One cell, after verifying its whole tile's checksum.
    [[nodiscard]] quantities::StoredCell read_cell(const parallel::CellIndex& cell) const;
    [[nodiscard]] TileState state(const parallel::Tile& tile) const;
    [[nodiscard]] double seconds(const parallel::Tile& tile) const;  // NaN for a tile that was never written

    [[nodiscard]] const parallel::Tiling& tiling() const { return tiling_; }

  private:
    void write_whole(const parallel::Tile& tile, std::span<const std::byte> bytes, const TileOrigin& origin);
    // A part of a tile's bytes, and the dataset and block in which it lies.
    struct Part {
        const hdf5::Stored& stored;
        hdf5::Block block;
        std::size_t bytes;
    };
    [[nodiscard]] std::vector<Part> parts(const parallel::Tile& tile) const;
    [[nodiscard]] std::vector<std::byte> read_whole(const parallel::Tile& tile) const;
    [[nodiscard]] std::vector<std::byte> read_bytes(const parallel::Tile& tile) const;
    [[nodiscard]] bool is_done(const parallel::Tile& tile) const;
    // Whether a tile's bytes match the checksum stored with it.
    [[nodiscard]] bool fits(const parallel::Tile& tile, std::span<const std::byte> bytes) const;

    hdf5::OpenMap map_;
    parallel::Tiling tiling_;
    std::vector<quantities::Field> fields_;
    std::int64_t samples_;                                      // of a sweep, per cell and variable
    std::vector<quantities::AttractorField> attractor_fields_;  // of a job with [starts]
    std::int64_t kept_;                                         // attractors of each cell there
    std::vector<quantities::OutcomeField> outcome_fields_;      // of a job with [uncertainty]
    std::vector<hdf5::Stored> datasets_;  // one per field and one per variable of which a cell has several
    hdf5::Stored checksum_;
    hdf5::Stored done_;
    hdf5::Stored seconds_;
    hdf5::Stored rank_;
};

}  // namespace peterka::map_file
