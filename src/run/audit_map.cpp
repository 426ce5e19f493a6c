#include "run/audit_map.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "parallel/dealing.hpp"
#include "regime/solve_cell.hpp"
#include "run/audit_sample.hpp"
#include "run/audit_tries.hpp"
#include "run/progress_style.hpp"
#include "support/stopwatch.hpp"

namespace peterka {
namespace {

using map_file::AuditRow;
using quantities::StoredCell;
using regime::Regime;

// The larger of the sensitivities of the map's own run and of the repeated solution.
double largest_sensitivity(const scene::Scene& scene, std::int64_t row, std::int64_t column,
                           const StoredCell& again) {
    return std::fmax(regime::solve_cell(scene, row, column).sensitivity, again.sensitivity);
}

// How weak a cell's claim may be: a label next to a different one may lie closer to its edge than the omitted
// terms move that edge, and the smaller a force, the larger its relative change may be. Smaller is weaker.
double strength_of(const StoredCell& cell, const StoredCell& neighbour) {
    if (cell.regime == Regime::failed) return std::numeric_limits<double>::infinity();
    const double force = cell.regime == Regime::periodic && cell.peak_force > 0 ? cell.peak_force : 1e300;
    return regime::same_label(cell, neighbour) ? force : force * 1e-200;
}

// Along the columns, or along the rows of a map with one column; the cell itself if there is no other.
parallel::CellIndex neighbour_of(const parallel::CellIndex& cell, const scene::Scene& scene) {
    const auto beside = [](std::int64_t n) { return n > 0 ? n - 1 : n + 1; };
    if (scene.columns() > 1) return {cell.row, beside(cell.column)};
    if (scene.rows() > 1) return {beside(cell.row), cell.column};
    return cell;
}

// Every second sample is the weakest of several drawn from its stretch: purely random sampling would hardly
// ever hit a kind of cell as rare as one in two hundred.
std::int64_t sampled_cell(const scene::Scene& scene, std::int64_t index, std::int64_t samples,
                          const map_file::MapFile& file) {
    constexpr std::int64_t draws = 8;
    std::int64_t weakest = audited_cell(index, samples, scene.job().cells());
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t draw = 0; index % 2 == 1 && draw < draws; ++draw) {
        const std::int64_t cell = audited_cell(index, samples, scene.job().cells(), draw);
        const std::int64_t row = cell / scene.columns();
        const std::int64_t column = cell % scene.columns();
        const parallel::CellIndex beside = neighbour_of({row, column}, scene);
        const double strength =
            strength_of(file.read_cell(row, column), file.read_cell(beside.row, beside.column));
        if (!(strength < least)) continue;
        least = strength;
        weakest = cell;
    }
    return weakest;
}

AuditRow audit_cell(const scene::Scene& scene, std::int64_t cell, const map_file::MapFile& file) {
    const Stopwatch stopwatch;
    const std::int64_t row = cell / scene.columns();
    const std::int64_t column = cell % scene.columns();
    const StoredCell first = file.read_cell(row, column);
    const StoredCell again = quantities::in_file_units(regime::solve_again(scene, row, column, first.engine),
                                                       scene.cell(row, column).scales);
    const bool agrees = regime::same_label(first, again);
    const AuditedCell tries = first.computed ? audit_tries(scene, row, column) : AuditedCell{};
    return {.cell = cell,
            .row = row,
            .column = column,
            .again = again,
            .force_error = first.computed ? map_file::force_error(first, again) : regime::unknown,
            .sensitivity = agrees ? regime::unknown : largest_sensitivity(scene, row, column, again),
            .agrees = agrees,
            .computed = first.computed,
            .starts = tries.starts,
            .rigs = tries.rigs,
            .seconds = stopwatch.seconds()};
}

}  // namespace

void audit_map(const parallel::Session& session, const RunPlan& plan, const scene::Scene& scene,
               const StopRequest& stop, map_file::MapFile& file) {
    const std::int64_t samples = map_file::audit_rows(plan.job);
    if (samples == 0) return;
    file.settle();
    const map_file::AuditTable table = file.audit();
    const parallel::Tiling tiling({samples, 1});
    parallel::TileSet missing(tiling.count());
    for (std::int64_t tile = 0; session.is_root() && tile < tiling.count(); ++tile) {
        const std::int64_t first = tiling.tile(tile).row;
        bool whole = true;
        for (std::int64_t i = first; i < first + tiling.tile(tile).size(); ++i) whole &= table.has(i);
        if (!whole) missing.add(tile);
    }
    Progress progress(progress_style(session, plan), samples, samples - parallel::cells_in(missing, tiling),
                      {.what = "audit"});
    const auto solve_tile = [&](const parallel::Tile& tile, const parallel::Poll& poll) {
        for (std::int64_t index = tile.row; index < tile.row + tile.size(); ++index) {
            poll();
            table.write(index, audit_cell(scene, sampled_cell(scene, index, samples, file), file));
        }
    };
    parallel::deal_tiles(session, tiling, std::move(missing),
                         {.solve = parallel::one_by_one(solve_tile),
                          .stop_requested = [&] { return stop.requested(); },
                          .on_progress = [&](std::int64_t solved) { progress.add(solved); }});
}

}  // namespace peterka
