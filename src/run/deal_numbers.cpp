#include "run/deal_numbers.hpp"

#include <span>

#include "parallel/collective.hpp"
#include "parallel/dealing.hpp"

namespace peterka {

std::vector<std::vector<double>> deal_numbers(
    const parallel::Session& session, const StopRequest& stop, std::int64_t count,
    const std::function<std::vector<double>(std::int64_t task)>& solve,
    const std::function<void(std::int64_t tasks)>& on_progress) {
    std::vector<std::vector<double>> results(static_cast<std::size_t>(count));
    if (count == 0) return results;
    std::vector<double> mine;  // task, length, numbers; and so on
    const auto solve_task = [&](const parallel::Tile& tile, const parallel::Poll& /*poll*/) {
        const std::vector<double> numbers = solve(tile.row);
        mine.insert(mine.end(), {static_cast<double>(tile.row), static_cast<double>(numbers.size())});
        mine.insert(mine.end(), numbers.begin(), numbers.end());
    };
    parallel::deal_tiles(session, parallel::Tiling({count, 1}, {1, 1}), parallel::TileSet::all(count),
                         {.solve = parallel::one_by_one(solve_task),
                          .stop_requested = [&] { return stop.requested(); },
                          .on_progress = on_progress});
    const std::vector<double> all = parallel::gather<double>(mine, session.communicator());
    for (std::span<const double> left(all); !left.empty();) {
        const auto length = static_cast<std::size_t>(left[1]);
        const auto numbers = left.subspan(2, length);
        results[static_cast<std::size_t>(left[0])].assign(numbers.begin(), numbers.end());
        left = left.subspan(2 + length);
    }
    return results;
}

}  // namespace peterka
