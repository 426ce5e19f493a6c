// The map file: one parallel HDF5 file into which every rank writes its finished tiles (layout.hpp).
//
// Rank 0 makes the file, with all its space and all its metadata, before any rank opens it (make_file.hpp).
// After that only plain numbers are written, so a kill at any moment leaves a readable file in which each tile
// marked done is whole. "Collective" functions are called by all ranks of the communicator in the same order,
// and an error on one rank is thrown on all. All throw Failure(ExitCode::output). The communicator must outlive
// the MapFile.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "attractors/along_branch.hpp"
#include "findings/attractors.hpp"
#include "findings/statistics.hpp"
#include "hdf5/checked.hpp"
#include "hdf5/disk_file.hpp"
#include "job/job.hpp"
#include "map_file/audit_table.hpp"
#include "map_file/inspect.hpp"
#include "map_file/make_file.hpp"
#include "map_file/map_size.hpp"
#include "map_file/parallel_file.hpp"
#include "map_file/provenance.hpp"
#include "map_file/run_facts.hpp"
#include "map_file/tile_store.hpp"
#include "parallel/tile_set.hpp"
#include "parallel/tiles.hpp"
#include "regime/branch.hpp"
#include "regime/cell_result.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

// Tiles that still have to be computed, the same on every rank.
struct RemainingTiles {
    parallel::TileSet tiles;
    std::int64_t damaged = 0;  // of these tiles, how many are marked done but fail their checksum
};

// The units of the cell in a row and column.
using ScalesOfCell = std::function<scene::Scales(std::int64_t row, std::int64_t column)>;

class MapFile {
  public:
    MapFile(MapFile&&) = delete;  // members refer to its address
    MapFile& operator=(MapFile&&) = delete;
    ~MapFile() = default;

    // Collective. Creates the file, as make_file() does: a complete map of that name is kept as
    // previous_name(path) until finish(). `scales` of a cell convert its CellResult to the units of the file.
    [[nodiscard]] static MapFile create(const std::filesystem::path& path, const job::Job& job,
                                        const Provenance& provenance, const ScalesOfCell& scales,
                                        MPI_Comm communicator);

    // Collective. Opens a file that inspect() has found to be this job's.
    [[nodiscard]] static MapFile open(const std::filesystem::path& path, const job::Job& job,
                                      const ScalesOfCell& scales, MPI_Comm communicator,
                                      Access access = Access::write);

    [[nodiscard]] const parallel::Tiling& tiling() const { return tiles_.tiling(); }

    // Independent: any rank, any tile, any order. `cells` row by row inside the tile; `seconds` spent on them.
    void write_tile(const parallel::Tile& tile, std::span<const attractors::SolvedCell> cells, double seconds);
    // The same for branches of a sweep, and with [starts] for the attractors of each point, which the branches
    // share.
    void write_branches(const parallel::Tile& tile, std::span<const regime::BranchPoint> points,
                        std::span<const attractors::PointAttractors> attractors, double seconds);

    // Rewrites a finished tile of a map with other attractors: slot after slot, cell by cell.
    void write_attractors(std::int64_t index, std::span<const quantities::StoredCell> cells,
                          std::span<const quantities::StoredAttractor> attractors);

    // Independent. Throws if the file's name is gone or leads to another file.
    void require_presence() const { disk_.require_presence(); }

    // Collective. Checks the tiles marked done against their checksums, each rank a share of them.
    [[nodiscard]] RemainingTiles remaining_tiles();

    // Collective. After it each rank may read what the others wrote.
    void settle();

    // Independent, for cells already written; those of other ranks only after settle().
    [[nodiscard]] quantities::StoredCell read_cell(std::int64_t row, std::int64_t column) const;
    [[nodiscard]] std::vector<quantities::StoredCell> read_tile(std::int64_t index) const;
    [[nodiscard]] std::vector<quantities::StoredAttractor> read_attractors(std::int64_t index) const;
    [[nodiscard]] std::vector<quantities::StoredOutcome> read_outcomes(std::int64_t index) const;
    // For a finished basin.
    [[nodiscard]] std::vector<findings::Attractor> basin_attractors() const;
    [[nodiscard]] AuditTable audit() const { return {open_map(), job_}; }

    // Collective. The result of the audit, on every rank; nothing if the job requests none.
    [[nodiscard]] std::optional<AuditReport> audit_report();

    // Collective. Counts and extremes of what the file holds, the same at any number of ranks.
    [[nodiscard]] findings::Statistics statistics();

    // Collective. Adds the facts of this run to those in the file; for a run that stops early.
    void record(const RunFacts& facts);

    // Collective, once all tiles are written and audited: numbers a basin's attractors, stores texts and facts,
    // seals the file, marks it finished and removes previous_name(path). `statistics` are those of
    // statistics(), `omitted` sentences.
    void finish(const findings::Statistics& statistics, std::span<const std::string> omitted,
                const RunFacts& facts);

    // Collective. Closes the file and reports errors that only closing reveals; the destructor closes silently.
    void close();

  private:
    MapFile(hdf5::Checked check, const job::Job& job, ScalesOfCell scales, MPI_Comm communicator,
            Access access);
    void seal();
    // The bytes of attractors and outcomes of cells, as in their tile.
    [[nodiscard]] std::vector<std::byte> bytes_of_slots(std::span<const attractors::SolvedCell> cells,
                                                        std::span<const scene::Scales> scales) const;
    [[nodiscard]] hdf5::OpenMap open_map() const { return {check_, file_.id(), disk_}; }

    hdf5::Checked check_;
    job::Job job_;
    std::int64_t audit_rows_;
    ScalesOfCell scales_;
    MPI_Comm communicator_;
    int rank_;
    ParallelFile file_;
    hdf5::DiskFile disk_;
    TileStore tiles_;
};

}  // namespace peterka::map_file
