// How many runs of tiles rank 0 deals in a second, and how long a rank waits for one.
//
// The tiles are empty and their turns lie apart, so that every run is a single tile; rank 0 serves and computes
// nothing; the others take tiles as fast as they get them. With more ranks than cores they share them, and rank
// 0's computing time for a run, which holds its idle looks too, says more than the runs in a second.
//   mpirun -n RANKS build/tests/deal_rate [TILES]
#include <fmt/format.h>

#include <sched.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "parallel/checked.hpp"
#include "parallel/deal_order.hpp"
#include "parallel/dealing.hpp"
#include "parallel/session.hpp"
#include "support/stopwatch.hpp"

namespace {

using namespace peterka;
using parallel::Session;
using parallel::TileSource;

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void only_serve(TileSource& tiles) {
    while (!tiles.ended() && tiles.carry_on()) sched_yield();
}

// Returns the seconds from each wish, which goes out with the tile before, to the tile.
std::vector<double> take_all(TileSource& tiles) {
    std::vector<double> waits;
    Stopwatch since_wish;
    while (tiles.carry_on()) {
        if (const auto tile = tiles.next()) {
            waits.push_back(since_wish.seconds());
            since_wish = Stopwatch();
            tiles.solved(*tile);
        } else if (tiles.ended()) {
            break;
        } else {
            sched_yield();
        }
    }
    return waits;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

ExitCode run(const Session& session, std::int64_t tiles) {
    if (session.size() < 2)
        throw Failure(ExitCode::bad_job, "deal_rate needs 2 ranks or more: mpirun -n 2 ...");
    const parallel::Tiling tiling({parallel::tile_extent.rows, 2 * tiles * parallel::tile_extent.columns});
    const parallel::DealOrder order(tiling, session.size());
    parallel::TileSet apart(tiling.count());
    for (std::int64_t turn = 0; turn < order.turns(); turn += 2) {
        if (const auto tile = order.tile(turn)) apart.add(*tile);
    }

    std::vector<double> waits;
    const Stopwatch wall;
    const double before = processor_seconds();
    parallel::deal_tiles(session, tiling, apart,
                         {.solve =
                              [&](TileSource& source) {
                                  if (session.is_root())
                                      only_serve(source);
                                  else
                                      waits = take_all(source);
                              },
                          .stop_requested = [] { return false; },
                          .on_progress = [](std::int64_t) {}});
    const double busy = processor_seconds() - before;
    const double mine = session.is_root() ? 0 : median(waits);
    double longest = 0;
    parallel::checked("MPI_Reduce",
                      MPI_Reduce(&mine, &longest, 1, MPI_DOUBLE, MPI_MAX, 0, session.communicator()));
    if (session.is_root()) {
        const auto count = static_cast<double>(tiles);
        fmt::print("{:>6}{:>10}{:>14.0f}{:>14.3f}{:>14.3f}\n", session.size(), tiles, count / wall.seconds(),
                   1e6 * busy / count, 1e6 * longest);
    }
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    const std::int64_t tiles = argc > 1 ? std::stoll(argv[1]) : 100'000;
    return parallel::run_in_session(argc, argv, [&](const Session& session) {
        if (session.is_root())
            fmt::print("{:>6}{:>10}{:>14}{:>14}{:>14}\n", "ranks", "runs", "runs/s", "us of rank 0",
                       "us waited");
        return run(session, tiles);
    });
}
