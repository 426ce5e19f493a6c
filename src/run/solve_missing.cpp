#include "run/solve_missing.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>
#include <vector>

#include "parallel/dealing.hpp"
#include "refine/region.hpp"
#include "refine/regions.hpp"
#include "run/known_attractors.hpp"
#include "run/known_motions.hpp"
#include "run/progress_style.hpp"
#include "run/solve_tiles.hpp"
#include "run/whole_branches.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using map_file::MapFile;
using parallel::Session;

using parallel::CellIndex;
using parallel::Tile;
using Results = std::span<const attractors::SolvedCell>;

// Every cell of a tile.
TileWork whole_tiles(MapFile& file) {
    return {.begin =
                [](const Tile& tile) {
                    std::vector<CellIndex> cells;
                    for (std::int64_t i = 0; i < tile.size(); ++i) {
                        cells.push_back(
                            {tile.row + i / tile.extent.columns, tile.column + i % tile.extent.columns});
                    }
                    return cells;
                },
            .go_on =
                [&](const Tile& tile, Results cells, double seconds) {
                    file.write_tile(tile, cells, seconds);
                    return std::vector<CellIndex>();
                }};
}

// The successive lattices of a region of tiles.
class RefinedRegions {
  public:
    RefinedRegions(const job::Job& job, MapFile& file) : job_(job), file_(file) {}

    [[nodiscard]] TileWork work() {
        return {.begin =
                    [this](const Tile& tile) {
                        auto& region = regions_.try_emplace(tile.index, job_, tile).first->second;
                        return region.next();
                    },
                .go_on = [this](const Tile& tile, Results cells,
                                double seconds) { return go_on(tile, cells, seconds); },
                .most_in_hand = refine::most_in_hand};
    }

  private:
    std::vector<CellIndex> go_on(const Tile& rectangle, Results cells, double seconds) {
        refine::Region& region = regions_.at(rectangle.index);
        region.put(cells);
        std::vector<CellIndex> places = region.next();
        if (!places.empty()) return places;
        const std::vector<Tile> tiles = refine::tiles_in(rectangle, file_.tiling());
        for (const Tile& tile : tiles) {
            file_.write_tile(tile, region.cells(tile), seconds / static_cast<double>(tiles.size()));
        }
        regions_.erase(rectangle.index);
        return places;
    }

    const job::Job& job_;
    MapFile& file_;
    std::unordered_map<std::int64_t, refine::Region> regions_;  // those in progress
};

// The tiles that the file lacks.
parallel::TileSet find_missing_tiles(const Session& session, const RunPlan& plan, MapFile& file) {
    map_file::RemainingTiles remaining = file.remaining_tiles();
    if (session.is_root() && remaining.damaged > 0 && !plan.quiet) {
        tell("peterka: {} tiles are damaged (wrong checksum) and are computed again\n", remaining.damaged);
    }
    add_tiles_to_tell_again(session, plan.job, file, remaining.tiles);
    return std::move(remaining.tiles);
}

}  // namespace

void solve_missing_tiles(const Session& session, const RunPlan& plan, const scene::Scene& scene,
                         const StopRequest& stop, MapFile& file) {
    const bool refines = plan.job.refine.levels > 0;
    const parallel::Tiling tiling =
        refines ? refine::regions_of(file.tiling().grid(), session.size()) : file.tiling();
    parallel::TileSet missing = find_missing_tiles(session, plan, file);
    if (refines) missing = refine::regions_with(missing, file.tiling(), tiling);
    const std::int64_t cells_missing = parallel::cells_in(missing, tiling);
    if (cells_missing == 0) return;
    Progress progress(progress_style(session, plan), plan.job.cells(), plan.job.cells() - cells_missing);
    const regime::AttractorTable known = find_known_attractors(session, scene, stop);
    RefinedRegions regions(plan.job, file);
    TileWork work = refines ? regions.work() : whole_tiles(file);
    // Lives take so much longer than all else that a rank with many tiles in hand leaves others without.
    if (plan.job.noise.any()) work.most_in_hand = 2;
    const auto solve = [&](parallel::TileSource& source) { solve_tiles(scene, known, work, source); };
    const bool sweeps = plan.job.kind == job::Kind::sweep;
    parallel::deal_tiles(session, tiling, std::move(missing),
                         {.solve = sweeps ? parallel::one_by_one(whole_branches(scene, file)) : solve,
                          .stop_requested = [&] { return stop.requested(); },
                          .on_progress =
                              [&](std::int64_t solved) {
                                  file.require_presence();
                                  progress.add(solved);
                              }});
}

}  // namespace peterka
