#include "parallel/dealing.hpp"

#include <cstdint>
#include <utility>

#include "parallel/broadcast.hpp"
#include "parallel/dealer.hpp"
#include "parallel/worker.hpp"

namespace peterka::parallel {

bool deal_tiles(const Session& session, const Tiling& tiling, std::vector<TileRange> missing,
                const DealtWork& work) {
    std::int64_t all_solved = 0;
    if (session.is_root()) {
        all_solved = Dealer(session, tiling, TilePool(std::move(missing)), work).run() ? 1 : 0;
    } else {
        Worker(session, tiling, work).run();
    }
    broadcast(session, all_solved);
    return all_solved != 0;
}

}  // namespace peterka::parallel
