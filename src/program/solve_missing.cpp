#include "program/solve_missing.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>
#include <vector>

#include "parallel/dealing.hpp"
#include "program/progress_style.hpp"
#include "program/solve_tiles.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using output::MapFile;
using parallel::Session;

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
    const TileWork work{.cells_to_solve =
                            [](const parallel::Tile& tile) {
                                std::vector<std::int64_t> all(static_cast<std::size_t>(tile.size()));
                                std::iota(all.begin(), all.end(), 0);
                                return all;
                            },
                        .store = [&](const parallel::Tile& tile, std::span<const regime::CellResult> cells,
                                     double seconds) { file.write_tile(tile, cells, seconds); }};
    return parallel::deal_tiles(
        session, tiling, std::move(missing),
        {.solve = [&](parallel::TileSource& source) { solve_tiles(scene, work, source); },
         .stop_requested = [&] { return stop.requested(); },
         .on_progress = [&](std::int64_t solved) { progress.add(solved); }});
}

}  // namespace peterka
