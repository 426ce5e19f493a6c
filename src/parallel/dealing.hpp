// Deals the tiles of a grid to all ranks and has each solve its share.
//
// Rank 0 deals and computes too, and answers the others whenever its own solver asks whether to carry on, about
// every half millisecond. The others request their next run when they begin the last tile of the present one,
// with enough tiles in hand to continue meanwhile. A rank without work sleeps between polls, so it leaves its
// core to a rank that computes.
#pragma once

#include <functional>
#include <optional>

#include "parallel/session.hpp"
#include "parallel/tile_set.hpp"
#include "parallel/tiles.hpp"

namespace peterka::parallel {

// The tiles dealt to a rank, one by one. It may work on several tiles at once and finish them in any order.
class TileSource {
  public:
    TileSource() = default;
    TileSource(const TileSource&) = delete;
    TileSource& operator=(const TileSource&) = delete;
    virtual ~TileSource() = default;

    // The next tile; none if none is available at present, or no more will come.
    virtual std::optional<Tile> next() = 0;
    [[nodiscard]] virtual bool ended() const = 0;  // no more will come
    // Reports this tile as solved and stored.
    virtual void solved(const Tile& tile) = 0;
    // Exchanges messages with the other ranks if they are due; to be called often. False once a stop was
    // requested: return at once, without storing or reporting the tiles that are not finished.
    virtual bool carry_on() = 0;
};

struct DealtWork {
    // Solves tiles until the source has ended and all are solved, or until it says not to carry on. Use
    // one_by_one where tiles are solved sequentially.
    std::function<void(TileSource& tiles)> solve;
    // Whether this rank was asked to stop; one rank's request stops all.
    std::function<bool()> stop_requested;
    // On rank 0: the number of further cells solved, by any rank.
    std::function<void(std::int64_t cells)> on_progress;
};

// solve_tile solves one tile and stores it. It calls `poll` between two cells, which throws Stopped if the tile
// is to be abandoned.
using Poll = std::function<void()>;
[[nodiscard]] std::function<void(TileSource& tiles)> one_by_one(
    std::function<void(const Tile& tile, const Poll& poll)> solve_tile);

// Waits a moment for tiles to arrive, leaving the core to other processes meanwhile.
void wait_for_tiles();

// Collective. `missing` holds the tiling's tiles that are to be solved; only rank 0's set counts. Throws
// Stopped, on every rank, if a stop was requested before all were solved. A failure on any rank must end all
// ranks: call this inside failing_ends_all.
void deal_tiles(const Session& session, const Tiling& tiling, TileSet missing, const DealtWork& work);

}  // namespace peterka::parallel
