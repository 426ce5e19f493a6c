// One rank's solving of the tiles that it is dealt: their cells side by side in one pool, in whatever order
// they come to an end.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "parallel/dealing.hpp"
#include "regime/attractor_table.hpp"
#include "scene/scene.hpp"
#include "support/stop_request.hpp"

namespace peterka {

struct TileWork {
    // The cells that are to be solved for a tile at first.
    std::function<std::vector<parallel::CellIndex>(const parallel::Tile& tile)> begin;
    // Takes their results, in the same order, and the seconds of computing that the tile took so far. Gives the
    // cells that are to be solved next; none once the tile is stored.
    std::function<std::vector<parallel::CellIndex>(
        const parallel::Tile& tile, std::span<const attractors::SolvedCell> results, double seconds)>
        go_on;
    // So many tiles are begun at most before one of them is stored.
    std::size_t most_in_hand = std::numeric_limits<std::size_t>::max();
};

// Keeps a pool full and steps it until the source has ended and all is solved, or it says not to carry on.
// add_cell: adds one more cell to the pool; false where none is at hand.
template <class Pool>
void keep_solving(Pool& pool, parallel::TileSource& source, const std::function<bool()>& add_cell) {
    try {
        while (source.carry_on()) {
            while (pool.has_room() && add_cell()) {
            }
            if (!pool.empty()) {
                pool.step();
            } else if (source.ended()) {
                return;
            } else {
                parallel::wait_for_tiles();
            }
        }
    } catch (const Stopped&) {
        return;  // in the middle of a cycle: nothing more comes out of this pool
    }
}

// For DealtWork::solve. known: attractors whose neighbourhoods end a cell's search.
void solve_tiles(const scene::Scene& scene, const regime::AttractorTable& known, const TileWork& work,
                 parallel::TileSource& source);

}  // namespace peterka
