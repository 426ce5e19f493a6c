// Deals made-up work under mpirun and says on rank 0 what became of it; tests/end_to_end/test_dealing.py looks
// at it.
//
// usage: dealing_check TILES (deal | holes | stop RANK | fail RANK | fail-everywhere | fail-on-root | numbers)
// Tile i is "solved" by counting to a number that differs from tile to tile. Each rank remembers what it
// solved; in the end rank 0 sums up: "finished F, solved S tiles, D twice, progress P cells, largest share M".
// "numbers": each tile's result is i % 5 numbers i/2; rank 0 says "R of N ranks have all numbers, T told".
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "parallel/checked.hpp"
#include "parallel/dealing.hpp"
#include "parallel/session.hpp"
#include "run/deal_numbers.hpp"
#include "support/stop_if_asked.hpp"
#include "support/stop_request.hpp"

namespace {

using namespace peterka;
using parallel::Session;

struct Task {
    std::int64_t tiles = 0;
    std::string what;
    int rank = -1;  // that stops or fails
};

parallel::TileSet tiles_to_do(const Task& task) {
    if (task.what != "holes") return parallel::TileSet::all(task.tiles);
    parallel::TileSet some(task.tiles);
    for (std::int64_t tile = 0; tile < task.tiles; ++tile) {
        if (tile % 7 != 3) some.add(tile);
    }
    return some;
}

void count_up(std::int64_t tile) {
    volatile double sum = 0;
    for (std::int64_t i = 0; i < 2000 + (tile * 7919) % 30000; ++i) sum = sum + static_cast<double>(i);
}

void fail_if_asked(const Session& session, const Task& task) {
    const bool everywhere = task.what == "fail-everywhere";
    const bool here = task.what == "fail" && session.rank() == task.rank;
    if (everywhere || here)
        throw Failure(ExitCode::output, fmt::format("the disk of rank {} is full", session.rank()));
}

void sum_up(const Session& session, bool finished, std::vector<int> solved, std::int64_t progress_cells) {
    const int own = std::accumulate(solved.begin(), solved.end(), 0);
    int largest_share = 0;
    std::vector<int> times(solved.size());
    parallel::checked("MPI_Reduce",
                      MPI_Reduce(&own, &largest_share, 1, MPI_INT, MPI_MAX, 0, session.communicator()));
    parallel::checked("MPI_Reduce", MPI_Reduce(solved.data(), times.data(), static_cast<int>(solved.size()),
                                               MPI_INT, MPI_SUM, 0, session.communicator()));
    if (!session.is_root()) return;
    fmt::print("finished {}, solved {} tiles, {} twice, progress {} cells, largest share {}\n",
               finished ? 1 : 0, std::ranges::count_if(times, [](int n) { return n > 0; }),
               std::ranges::count_if(times, [](int n) { return n > 1; }), progress_cells, largest_share);
}

std::vector<double> numbers_of(std::int64_t tile) {
    return std::vector<double>(static_cast<std::size_t>(tile % 5), 0.5 * static_cast<double>(tile));
}

ExitCode deal_numbers_of(const Session& session, std::int64_t tiles) {
    const StopRequest stop;
    std::int64_t told = 0;
    const auto count = [&](std::int64_t solved) { told += solved; };
    const auto all = deal_numbers(session, stop, tiles, numbers_of, count);
    bool has_all = std::ssize(all) == tiles;
    for (std::int64_t tile = 0; tile < tiles && has_all; ++tile)
        has_all = all[static_cast<std::size_t>(tile)] == numbers_of(tile);
    const int own = has_all ? 1 : 0;
    int ranks = 0;
    parallel::checked("MPI_Reduce", MPI_Reduce(&own, &ranks, 1, MPI_INT, MPI_SUM, 0, session.communicator()));
    if (session.is_root())
        fmt::print("{} of {} ranks have all numbers, {} told\n", ranks, session.size(), told);
    return ExitCode::done;
}

ExitCode run(const Session& session, const Task& task) {
    if (task.what == "numbers") return deal_numbers_of(session, task.tiles);
    parallel::on_root(session, [&] {
        if (task.what == "fail-on-root") throw Failure(ExitCode::bad_job, "the job is bad");
    });
    const parallel::Tiling tiling({parallel::tile_extent.rows, task.tiles * parallel::tile_extent.columns});
    std::vector<int> solved(static_cast<std::size_t>(task.tiles));
    std::int64_t progress_cells = 0;
    std::int64_t own_tiles = 0;
    const parallel::DealtWork work{
        .solve = parallel::one_by_one([&](const parallel::Tile& tile, const parallel::Poll& poll) {
            if (own_tiles == 2) fail_if_asked(session, task);
            for (int cell = 0; cell < 4; ++cell) {
                poll();
                count_up(tile.index);
            }
            ++solved[static_cast<std::size_t>(tile.index)];
            ++own_tiles;
        }),
        .stop_requested = [&] { return task.what == "stop" && session.rank() == task.rank && own_tiles >= 2; },
        .on_progress = [&](std::int64_t cells) { progress_cells += cells; },
    };
    bool finished = true;
    try {
        parallel::deal_tiles(session, tiling, tiles_to_do(task), work);
    } catch (const Stopped&) {
        finished = false;
    }
    sum_up(session, finished, solved, progress_cells);
    return finished ? ExitCode::done : ExitCode::stopped_early;
}

}  // namespace

int main(int argc, char** argv) {
    const Task task{std::stoll(argv[1]), argv[2], argc > 3 ? std::stoi(argv[3]) : -1};
    return parallel::run_in_session(argc, argv, [&](const Session& session) { return run(session, task); });
}
