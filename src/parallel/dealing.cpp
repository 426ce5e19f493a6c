#include "parallel/dealing.hpp"

#include <cstdint>
#include <utility>

#include "parallel/broadcast.hpp"
#include "parallel/dealer.hpp"
#include "parallel/worker.hpp"
#include "support/stop_request.hpp"

namespace peterka::parallel {

std::function<void(TileSource& tiles)> one_by_one(
    std::function<bool(const Tile& tile, const CarryOn& carry_on)> solve_tile) {
    return [solve_tile = std::move(solve_tile)](TileSource& tiles) {
        const CarryOn carry_on = [&] { return tiles.carry_on(); };
        while (carry_on()) {
            const auto tile = tiles.next();
            if (tile) {
                try {
                    if (!solve_tile(*tile, carry_on)) return;
                } catch (const Stopped&) {
                    return;
                }
                tiles.solved(*tile);
            } else if (tiles.ended()) {
                return;
            } else {
                wait_for_tiles();
            }
        }
    };
}

void wait_for_tiles() {
    rest();
}

bool deal_tiles(const Session& session, const Tiling& tiling, TileSet missing, const DealtWork& work) {
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
    return all_solved != 0;
}

}  // namespace peterka::parallel
