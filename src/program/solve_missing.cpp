#include "program/solve_missing.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "parallel/dealing.hpp"
#include "program/progress_style.hpp"
#include "regime/solve_cell.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using output::MapFile;
using parallel::Session;

// Returns false if it gave the tile up because `carry_on` said so.
bool solve_tile(const scene::Scene& scene, const parallel::Tile& tile, const parallel::CarryOn& carry_on,
                MapFile& file) {
    const Stopwatch stopwatch;
    std::vector<regime::CellResult> cells;
    cells.reserve(static_cast<std::size_t>(tile.size()));
    for (std::int64_t cell = 0; cell < tile.size(); ++cell) {
        if (!carry_on()) return false;
        const std::int64_t row = tile.row + cell / tile.extent.columns;
        const std::int64_t column = tile.column + cell % tile.extent.columns;
        cells.push_back(regime::solve_cell(scene, row, column));
    }
    file.write_tile(tile, cells, stopwatch.seconds());
    return true;
}

// The tiles that the file lacks, on rank 0.
std::vector<parallel::TileRange> find_missing_tiles(const Session& session, const RunPlan& plan,
                                                    MapFile& file) {
    const output::RemainingTiles remaining = file.remaining_tiles();
    if (!session.is_root()) return {};
    if (remaining.damaged > 0 && !plan.quiet) {
        tell("peterka: {} tiles are damaged (wrong checksum) and are computed again\n", remaining.damaged);
    }
    return remaining.ranges;
}

}  // namespace

bool solve_missing_tiles(const Session& session, const RunPlan& plan, const scene::Scene& scene,
                         const StopRequest& stop, MapFile& file) {
    const parallel::Tiling tiling({scene.rows(), scene.columns()});
    std::vector<parallel::TileRange> missing = find_missing_tiles(session, plan, file);
    Progress progress(progress_style(session, plan), plan.job.cells(),
                      plan.job.cells() - parallel::cells_in(missing, tiling));
    return parallel::deal_tiles(session, tiling, std::move(missing),
                                {.solve_tile =
                                     [&](const parallel::Tile& tile, const parallel::CarryOn& carry_on) {
                                         return solve_tile(scene, tile, carry_on, file);
                                     },
                                 .stop_requested = [&] { return stop.requested(); },
                                 .on_progress = [&](std::int64_t solved) { progress.add(solved); }});
}

}  // namespace peterka
