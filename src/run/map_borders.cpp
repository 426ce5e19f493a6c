#include "run/map_borders.hpp"

#include <algorithm>
#include <cstdint>

#include "curves/border_words.hpp"
#include "curves/search.hpp"
#include "parallel/broadcast.hpp"
#include "run/deal_numbers.hpp"
#include "scene/scene.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka {

namespace {

// Orbits are sought in a map of the same window with no more cells than curves need, and without settings that
// concern files.
job::Job coarse_job(const job::Job& map) {
    constexpr std::int64_t most_points = 128;  // along an axis: enough to miss no edge of the paper's rigs
    job::Job coarse = map;
    coarse.kind = job::Kind::curves;
    coarse.columns.points = std::min(coarse.columns.points, most_points);
    coarse.rows.points = std::min(coarse.rows.points, most_points);
    coarse.starts = {};
    coarse.uncertainty = {};
    coarse.refine = {};
    coarse.output = {};
    coarse.audit = {};
    return coarse;
}

}  // namespace

std::string map_borders(const parallel::Session& session, const RunPlan& plan, const StopRequest& stop) {
    if (plan.job.kind != job::Kind::map || plan.job.curves.gaps().empty()) return "";
    std::int64_t quiet = plan.quiet ? 1 : 0;  // known to rank 0 only
    parallel::broadcast(session, quiet);
    if (quiet != 0) return "";
    const scene::Scene scene(coarse_job(plan.job));
    try {
        const auto deal = [&](std::int64_t count, const curves::Task& task, const curves::Done& done) {
            return deal_numbers(session, stop, count, task, done);
        };
        const auto found = curves::find_curves(scene, deal);
        return "\n" + curves::borders_in_words(scene, found);
    } catch (const Stopped&) {  // all ranks come here together; the file is complete
        return "\nNo border is told: stopped before they were traced; the same command tells them\n";
    }
}

}  // namespace peterka
