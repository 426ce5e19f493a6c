// Deals the tiles of a grid to all ranks and has each solve its share.
//
// Rank 0 deals and computes too. It answers the others between two of its own cells, so a request waits for one
// cell at most; the others ask for their next run before they have done the present one. Without anything to
// compute a rank sleeps between looks, so it leaves its core to a rank that computes.
#pragma once

#include <functional>
#include <vector>

#include "parallel/session.hpp"
#include "parallel/tile_pool.hpp"
#include "parallel/tiles.hpp"

namespace peterka::parallel {

// True while the computing should go on. To be called between two cells.
using CarryOn = std::function<bool()>;

struct DealtWork {
    // Solves one tile and stores it. Returns false if it gave the tile up because `carry_on` said so.
    std::function<bool(const Tile& tile, const CarryOn& carry_on)> solve_tile;
    // Whether this rank was asked to stop; one rank's wish stops all.
    std::function<bool()> stop_requested;
    // On rank 0: so many more cells were solved, by any rank.
    std::function<void(std::int64_t cells)> on_progress;
};

// Collective. `missing` counts on rank 0 alone: the tiles to solve. Returns, on every rank, whether all of them
// were solved. A failure on any rank must end all ranks: call this inside failing_ends_all.
[[nodiscard]] bool deal_tiles(const Session& session, const Tiling& tiling, std::vector<TileRange> missing,
                              const DealtWork& work);

}  // namespace peterka::parallel
