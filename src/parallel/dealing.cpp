#include "parallel/dealing.hpp"

#include <cstdint>
#include <utility>

#include "parallel/broadcast.hpp"
#include "parallel/dealer.hpp"
#include "parallel/worker.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::parallel {

std::function<void(TileSource& tiles)> one_by_one(
    std::function<void(const Tile& tile, const Poll& poll)> solve_tile) {
    return [solve_tile = std::move(solve_tile)](TileSource& tiles) {
        const Poll poll = [&] {
            if (!tiles.carry_on()) throw Stopped();
        };
        try {
            while (tiles.carry_on()) {
                const auto tile = tiles.next();
                if (tile) {
                    solve_tile(*tile, poll);
                    tiles.solved(*tile);
                } else if (tiles.ended()) {
                    return;
                } else {
                    wait_for_tiles();
                }
            }
        } catch (const Stopped&) {
            return;  // the tile in hand is dropped; deal_tiles tells all ranks
        }
    };
}

void wait_for_tiles() {
    rest();
}

void deal_tiles(const Session& session, const Tiling& tiling, TileSet missing, const DealtWork& work) {
    std::int64_t all_solved = 0;
    if (session.is_root()) {
        all_solved =
            Dealer(session, tiling, TilePool(DealOrder(tiling, session.size()), std::move(missing)), work).run()
                ? 1
                : 0;
    } else {
        Worker(session, tiling, work).run();
    }
    broadcast(session, all_solved);
    if (all_solved == 0) throw Stopped();
}

}  // namespace peterka::parallel
