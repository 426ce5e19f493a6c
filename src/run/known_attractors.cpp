#include "run/known_attractors.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/broadcast.hpp"
#include "parallel/collective.hpp"
#include "parallel/dealing.hpp"
#include "parallel/listed_tiles.hpp"
#include "regime/search_pool.hpp"
#include "run/solve_tiles.hpp"

namespace peterka {
namespace {

// One pilot per 8 by 8 cells costs little, and 16 by 16 of them miss one in twelve of the attractors that take
// a percent of the plane; each start finds by itself what they miss.
constexpr std::int64_t cells_along_per_pilot = 8;
constexpr std::int64_t most_pilots_along = 16;

job::Job pilot_job(job::Job job) {
    for (job::Axis* axis : {&job.rows, &job.columns}) {
        axis->points = std::clamp<std::int64_t>(axis->points / cells_along_per_pilot, 1, most_pilots_along);
    }
    return job;
}

struct PilotAttractor {
    std::int64_t pilot;
    regime::FoundAttractor attractor;
};

// This rank's share of the pilots, side by side.
void solve_pilots(const scene::Scene& pilots, const parallel::Tiling& tiling, parallel::TileSource& source,
                  std::vector<PilotAttractor>& found) {
    const regime::AttractorTable nothing_known;
    regime::SearchPool pool(
        pilots, nothing_known,
        [&](const regime::SearchPool::NumberedOutcome& pilot) {
            for (const regime::FoundAttractor& attractor : pilot.outcome.found) {
                found.push_back({pilot.number, attractor});
            }
            source.solved(tiling.tile(pilot.number));
        },
        regime::SearchPool::Attractors::reported);
    keep_solving(pool, source, [&] {
        const auto pilot = source.next();
        if (pilot) pool.add(pilot->row, pilot->column, pilot->index);
        return pilot.has_value();
    });
}

regime::AttractorTable table_of(const scene::Scene& scene, std::int64_t pilots,
                                std::vector<PilotAttractor> all) {
    std::ranges::stable_sort(all, {}, &PilotAttractor::pilot);
    std::vector<regime::FoundAttractor> found;
    found.reserve(all.size());
    for (const PilotAttractor& each : all) found.push_back(each.attractor);
    const double cells_each = static_cast<double>(scene.job().cells()) / static_cast<double>(pilots);
    return {scene.cell(0, 0).oscillator, found, cells_each};
}

}  // namespace

regime::AttractorTable find_known_attractors(const parallel::Session& session, const scene::Scene& scene,
                                             const StopRequest& stop) {
    if (scene.job().kind != job::Kind::basin) return {};
    const scene::Scene pilots(pilot_job(scene.job()));
    const parallel::Tiling tiling({pilots.rows(), pilots.columns()}, {1, 1});
    std::vector<PilotAttractor> mine;
    parallel::deal_tiles(session, tiling, parallel::TileSet::all(tiling.count()),
                         {.solve = [&](auto& source) { solve_pilots(pilots, tiling, source, mine); },
                          .stop_requested = [&] { return stop.requested(); },
                          .on_progress = [](std::int64_t) {}});

    std::vector<PilotAttractor> all = parallel::gather<PilotAttractor>(mine, session.communicator());
    regime::AttractorTable table;
    parallel::together(session.communicator(),
                       [&] { table = table_of(scene, tiling.count(), std::move(all)); });
    return table;
}

regime::AttractorTable find_known_attractors(const scene::Scene& scene) {
    if (scene.job().kind != job::Kind::basin) return {};
    const scene::Scene pilots(pilot_job(scene.job()));
    const parallel::Tiling tiling({pilots.rows(), pilots.columns()}, {1, 1});
    std::vector<parallel::Tile> all;
    for (std::int64_t n = 0; n < tiling.count(); ++n) all.push_back(tiling.tile(n));
    parallel::ListedTiles source(std::move(all));
    std::vector<PilotAttractor> found;
    solve_pilots(pilots, tiling, source, found);
    return table_of(scene, tiling.count(), std::move(found));
}

}  // namespace peterka
