// Deals the tiles of a grid to all ranks and has each solve its share.
//
// Rank 0 deals and computes too, and answers the others when its own solving asks whether to carry on, every
// half a millisecond or so. The others ask for their next run when they begin the last tile of the present one,
// with tiles enough in hand to go on meanwhile. Without anything to compute a rank sleeps between looks, so it
// leaves its core to a rank that computes.
#pragma once

#include <functional>
#include <optional>

#include "parallel/session.hpp"
#include "parallel/tile_set.hpp"
#include "parallel/tiles.hpp"

namespace peterka::parallel {

// What a rank is dealt, tile by tile. It may work at several tiles at once and finish them in any order.
class TileSource {
  public:
    TileSource() = default;
    TileSource(const TileSource&) = delete;
    TileSource& operator=(const TileSource&) = delete;
    virtual ~TileSource() = default;

    // The next tile; none where none is at hand just now, or no more will come.
    virtual std::optional<Tile> next() = 0;
    [[nodiscard]] virtual bool ended() const = 0;  // no more will come
    // This one is solved and stored.
    virtual void solved(const Tile& tile) = 0;
    // To be called often. False: leave everything as it is, somebody asked to stop.
    virtual bool carry_on() = 0;
};

struct DealtWork {
    // Solves tiles until the source has ended and all are solved, or it says not to carry on. To be made with
    // one_by_one where tiles are solved one after the other.
    std::function<void(TileSource& tiles)> solve;
    // Whether this rank was asked to stop; one rank's request stops all.
    std::function<bool()> stop_requested;
    // On rank 0: so many more cells were solved, by any rank.
    std::function<void(std::int64_t cells)> on_progress;
};

// solve_tile solves one tile and stores it. It calls `poll` between two cells, which throws Stopped where the
// tile is to be given up.
using Poll = std::function<void()>;
[[nodiscard]] std::function<void(TileSource& tiles)> one_by_one(
    std::function<void(const Tile& tile, const Poll& poll)> solve_tile);

// Waits a moment for tiles to come, and leaves the core to others meanwhile.
void wait_for_tiles();

// Collective. `missing` holds those of the tiling's tiles that are to be solved, and counts on rank 0 alone.
// Throws Stopped, on every rank, where somebody asked to stop before all of them were solved. A failure on any
// rank must end all ranks: call this inside failing_ends_all.
void deal_tiles(const Session& session, const Tiling& tiling, TileSet missing, const DealtWork& work);

}  // namespace peterka::parallel
