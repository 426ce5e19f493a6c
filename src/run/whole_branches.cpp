#include "run/whole_branches.hpp"

#include <cstddef>
#include <iterator>
#include <vector>

#include "attractors/along_branch.hpp"
#include "regime/branch.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"
#include "run/certify_cell.hpp"
#include "run/elasticities.hpp"
#include "run/mean_lives.hpp"
#include "support/stopwatch.hpp"

namespace peterka {
namespace {

using attractors::PointAttractors;
using regime::BranchPoint;

// Sets the attractor on which each point of each branch lies. most: attractors kept per point.
void name_attractors(std::vector<BranchPoint>& branches, std::vector<PointAttractors>& attractors,
                     std::int64_t most) {
    for (std::size_t column = 0; column < attractors.size(); ++column) {
        std::vector<const BranchPoint*> here;
        for (std::size_t i = column; i < branches.size(); i += attractors.size()) here.push_back(&branches[i]);
        keep_with(attractors[column], here, most);
    }
    for (std::size_t i = 0; i < branches.size() && !attractors.empty(); ++i) {
        regime::CellResult& cell = branches[i].cell;
        cell.attractors = attractors[i % attractors.size()].count;
        cell.start_attractor = slot_of(attractors[i % attractors.size()], cell);
    }
}

// What the rigs drawn at a point tell, whichever branch is on it.
void tell_of_rigs(std::vector<BranchPoint>& branches, const std::vector<PointAttractors>& points) {
    for (std::size_t i = 0; i < branches.size(); ++i) {
        const regime::CellResult& of_rigs = points[i % points.size()].of_rigs;
        for (const cell::Quantity& quantity : cell::quantities) {
            if (cell::is_of_uncertain_rigs(quantity)) quantity.store(branches[i].cell, quantity.load(of_rigs));
        }
    }
}

void certify(const scene::Scene& scene, std::int64_t row, std::int64_t column, BranchPoint& point,
             const parallel::Poll& poll) {
    const auto settled = certify_cell(scene.job(), row, column, point.cell);
    if (!settled) return;
    scene::Cell cell = scene.cell(row, column);
    cell.start = start_of_search(cell, *settled);
    regime::SteadyMotion motion(static_cast<std::size_t>(scene.job().sweep.samples));
    regime::CycleBroker broker;
    const Task<regime::CellResult> search = regime::solve_cell(broker, scene.job(), cell, {}, &motion);
    regime::run(search, broker, poll);
    regime::CellResult there = search.result();
    if (!replaces(scene.job(), row, column, *settled, point.cell, there)) return;
    point.cell = there;
    point.motion = std::move(motion);
}

}  // namespace

std::function<void(const parallel::Tile& tile, const parallel::Poll& poll)> whole_branches(
    const scene::Scene& scene, map_file::MapFile& file) {
    return [&, elasticities = RequestedElasticities(scene.job())](const parallel::Tile& tile,
                                                                  const parallel::Poll& poll) {
        const Stopwatch stopwatch;
        std::vector<PointAttractors> attractors;
        if (scene.job().starts.count > 0) {
            attractors = attractors::find_along_branch(scene, tile.row, poll);
        } else if (scene.job().uncertainty.rigs > 0) {
            attractors = attractors::find_outcomes_along_branch(scene, tile.row, poll);
        }
        std::vector<BranchPoint> points;
        for (std::int64_t row = tile.row; row < tile.row + tile.extent.rows; ++row) {
            std::vector<BranchPoint> branch = regime::follow_branch(scene, row, poll);
            for (std::size_t column = 0; column < branch.size(); ++column) {
                poll();
                certify(scene, row, static_cast<std::int64_t>(column), branch[column], poll);
                elasticities.add_to(row, static_cast<std::int64_t>(column), branch[column].cell);
                add_mean_life(scene, row, static_cast<std::int64_t>(column), branch[column].cell);
            }
            regime::mark_jumps(scene, row, branch, poll);
            points.insert(points.end(), std::make_move_iterator(branch.begin()),
                          std::make_move_iterator(branch.end()));
        }
        if (scene.job().starts.count > 0) name_attractors(points, attractors, scene.job().starts.attractors);
        if (scene.job().uncertainty.rigs > 0) tell_of_rigs(points, attractors);
        for (std::size_t column = 0; column < attractors.size(); ++column) {
            for (attractors::CellAttractor& each : attractors[column].kept) {
                poll();
                add_mean_life(scene, tile.row, static_cast<std::int64_t>(column), each);
            }
        }
        file.write_branches(tile, points, attractors, stopwatch.seconds());
    };
}

}  // namespace peterka
