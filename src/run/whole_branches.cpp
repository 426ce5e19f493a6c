#include "run/whole_branches.hpp"

#include <cstddef>
#include <iterator>
#include <vector>

#include "attractors/along_branch.hpp"
#include "regime/branch.hpp"
#include "support/stopwatch.hpp"

namespace peterka {
namespace {

using attractors::PointAttractors;
using regime::BranchPoint;

// Which of the attractors each point of a branch is on.
void name_attractors(std::vector<BranchPoint>& branch, const std::vector<PointAttractors>& attractors) {
    for (std::size_t column = 0; column < attractors.size(); ++column) {
        regime::CellResult& cell = branch[column].cell;
        cell.attractors = attractors[column].count;
        cell.start_attractor = slot_of(attractors[column], cell);
    }
}

}  // namespace

std::function<void(const parallel::Tile& tile, const parallel::Look& look)> whole_branches(
    const scene::Scene& scene, map_file::MapFile& file) {
    return [&](const parallel::Tile& tile, const parallel::Look& look) {
        const Stopwatch stopwatch;
        std::vector<PointAttractors> attractors;
        if (scene.job().starts.count > 0) {
            attractors = attractors::find_along_branch(scene, tile.row, look);
        }
        std::vector<BranchPoint> points;
        for (std::int64_t row = tile.row; row < tile.row + tile.extent.rows; ++row) {
            std::vector<BranchPoint> branch = regime::follow_branch(scene, row, look);
            name_attractors(branch, attractors);
            points.insert(points.end(), std::make_move_iterator(branch.begin()),
                          std::make_move_iterator(branch.end()));
        }
        file.write_branches(tile, points, attractors, stopwatch.seconds());
    };
}

}  // namespace peterka
