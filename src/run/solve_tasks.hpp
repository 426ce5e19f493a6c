// The computation of a study: its tasks are dealt to all ranks, with all results returned to every rank.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/collective.hpp"
#include "parallel/dealing.hpp"
#include "run/progress_style.hpp"
#include "run/run_plan.hpp"
#include "study/table.hpp"
#include "support/progress.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all. Throws Stopped, on every rank, if a stop is requested before the end.
template <study::Topic Topic>
[[nodiscard]] std::vector<typename Topic::Result> solve_tasks(const parallel::Session& session,
                                                              const RunPlan& plan, const Topic& topic,
                                                              const StopRequest& stop) {
    using Result = typename Topic::Result;
    struct NumberedResult {
        std::int64_t task = 0;
        Result result;
    };
    const std::int64_t tasks = topic.tasks();
    const parallel::Tiling tiling({tasks, 1}, {1, 1});
    std::vector<NumberedResult> mine;
    Progress progress(progress_style(session, plan), tasks, 0, {.what = "compare"});
    const auto solve_task = [&](const parallel::Tile& tile, const parallel::Poll& /*poll*/) {
        mine.push_back({tile.row, topic.solve(tile.row)});
    };
    parallel::deal_tiles(session, tiling, parallel::TileSet::all(tasks),
                         {.solve = parallel::one_by_one(solve_task),
                          .stop_requested = [&] { return stop.requested(); },
                          .on_progress = [&](std::int64_t done) { progress.add(done); }});
    std::vector<Result> results(static_cast<std::size_t>(tasks));
    for (const NumberedResult& each : parallel::gather<NumberedResult>(mine, session.communicator())) {
        results[static_cast<std::size_t>(each.task)] = each.result;
    }
    return results;
}

}  // namespace peterka
