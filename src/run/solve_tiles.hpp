// One rank's solution of the tiles dealt to it: their cells are solved side by side in one pool, and finish in
// any order.
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
    // The cells to be solved first for a tile.
    std::function<std::vector<parallel::CellIndex>(const parallel::Tile& tile)> begin;
    // Takes their results, in the same order, and the computing time of the tile so far [s]. Returns the cells
    // to be solved next; none once the tile is stored.
    std::function<std::vector<parallel::CellIndex>(
        const parallel::Tile& tile, std::span<const attractors::SolvedCell> results, double seconds)>
        go_on;
    // At most this many tiles are begun before one of them is stored.
    std::size_t most_in_hand = std::numeric_limits<std::size_t>::max();
};

// Keeps a pool full and steps it until the source has ended and all is solved, or the source says to stop.
// add_cell: adds one more cell to the pool; false if none is available.
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
        return;  // in the middle of a cycle: this pool yields no further results
    }
}

// For DealtWork::solve. known: attractors whose neighbourhoods end a cell's search.
void solve_tiles(const scene::Scene& scene, const regime::AttractorTable& known, const TileWork& work,
                 parallel::TileSource& source);

}  // namespace peterka
