#include "run/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "map_file/make_file.hpp"
#include "map_file/map_file.hpp"
#include "map_file/output_lock.hpp"
#include "map_file/provenance.hpp"
#include "report/omitted.hpp"
#include "report/summary.hpp"
#include "run/audit_map.hpp"
#include "run/known_motions.hpp"
#include "run/map_borders.hpp"
#include "run/solve_missing.hpp"
#include "run/words.hpp"
#include "scene/scene.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using map_file::Existing;
using map_file::MapFile;
using parallel::Session;

MapFile open_or_create(const Session& session, const RunPlan& plan, const scene::Scene& scene,
                       std::optional<map_file::FileLock>& lock) {
    if (plan.existing == Existing::absent) {
        parallel::on_root(session, [&] {
            map_file::make_file(plan.file, plan.job, map_file::collect_provenance());
            lock.emplace(plan.file);
        });
    }
    const auto access = plan.existing == Existing::complete ? map_file::Access::read : map_file::Access::write;
    return MapFile::open(
        plan.file, plan.job,
        [&scene](std::int64_t row, std::int64_t column) { return scene.cell(row, column).scales; },
        session.communicator(), access);
}

// Rank 0 alone, once every rank's branches are in the file.
SweepFindings find_in_sweep(const Session& session, const RunPlan& plan, const MapFile& file) {
    SweepFindings found;
    if (plan.job.kind != job::Kind::sweep || plan.quiet || !session.is_root()) return found;
    const std::int64_t columns = plan.job.columns.points;
    for (std::int64_t index = 0; index < file.tiling().count(); ++index) {
        const std::vector<quantities::StoredCell> cells = file.read_tile(index);
        for (auto row = cells.begin(); row != cells.end(); row += columns) {
            found.branches.push_back(
                find_in_branch(plan.job.sweep.branch(std::ssize(found.branches)), {row, row + columns}));
        }
        if (plan.job.starts.count == 0) continue;
        found.beside.push_back(find_beside_branches(cells, file.read_attractors(index), columns));
    }
    return found;
}

// Rank 0 alone, once the attractors are numbered.
std::vector<findings::Attractor> find_in_basin(const Session& session, const RunPlan& plan,
                                               const MapFile& file) {
    if (plan.job.kind != job::Kind::basin || plan.quiet || !session.is_root()) return {};
    return file.basin_attractors();
}

// A finished map is reported as it is, so it must be what was computed.
void refuse_damage(const RunPlan& plan, const map_file::RemainingTiles& remaining) {
    if (remaining.tiles.empty()) return;
    throw Failure(
        ExitCode::output,
        fmt::format("{}: {} tiles of this finished map are damaged (wrong checksum); don't trust it, and "
                    "compute it again with --fresh",
                    plan.file.string(), remaining.tiles.size()));
}

std::string summary(const Session& session, const RunPlan& plan, const scene::Scene& scene,
                    const RunResults& findings, const std::string& borders, const Stopwatch& wall) {
    if (!session.is_root() || plan.quiet) return "";
    const bool complete = plan.existing == Existing::complete;
    return (complete ? fmt::format("{} is complete: nothing is computed\n", plan.file.string()) : "") +
           summary_text({scene, findings, plan.file, {session.size(), wall.seconds()}, borders});
}

void say_how_to_continue(const Session& session, const RunPlan& plan, const StopRequest& stop) {
    if (!session.is_root()) return;
    if (plan.existing == Existing::complete) {
        tell("peterka: stopped early ({}), before {} was read; it is complete\n", stop.reason(),
             plan.file.string());
        return;
    }
    tell("peterka: stopped early ({}); what is finished is kept, and the same command{} goes on from {}\n",
         stop.reason(), plan.fresh ? " without --fresh" : "", plan.file.string());
}

ExitCode judge(const Session& session, const RunPlan& plan, const findings::Statistics& statistics) {
    const std::int64_t failed = statistics.cells_of(regime::Regime::failed);
    if (failed <= plan.job.limits.failed_cells) return ExitCode::done;
    if (session.is_root()) {
        tell("peterka: {} cells failed, and the job allows {} (limits.failed_cells)\n", failed,
             plan.job.limits.failed_cells);
    }
    return ExitCode::too_many_failures;
}

}  // namespace

ExitCode run_job(const Session& session, const RunPlan& plan) {
    const Stopwatch wall;
    const StopRequest stop(plan.max_wall_seconds);
    const scene::Scene scene(plan.job);
    std::optional<map_file::FileLock> lock;  // of a file created now
    MapFile file = open_or_create(session, plan, scene, lock);
    ExitCode code = ExitCode::stopped_early;
    std::string words;

    // Ranks work alone from here on, and the file's destructor would wait for all of them.
    parallel::failing_ends_all(session, [&] {
        const bool complete = plan.existing == Existing::complete;
        const Stopwatch solving;
        double solve_seconds = 0;
        const auto facts = [&] {
            return map_file::RunFacts{session.size(), wall.seconds(), host_names(session, plan), solve_seconds};
        };
        try {
            if (complete) refuse_damage(plan, file.remaining_tiles());
            if (!complete) solve_missing_tiles(session, plan, scene, stop, file);
            if (!complete) add_known_motions(session, scene, file);
            solve_seconds = solving.seconds();
            if (!complete) audit_map(session, plan, scene, stop, file);
            const findings::Statistics statistics = file.statistics();
            const std::vector<std::string> omitted = omitted_in_words(plan.job, statistics);
            if (!complete) file.finish(statistics, omitted, facts());
            const std::string borders = map_borders(session, plan, stop);
            words = summary(session, plan, scene,
                            {statistics, file.audit_report(), omitted, find_in_sweep(session, plan, file),
                             find_in_basin(session, plan, file)},
                            borders, wall);
            code = judge(session, plan, statistics);
        } catch (const Stopped&) {  // all ranks come here together
            if (solve_seconds == 0) solve_seconds = solving.seconds();
            if (!complete) file.record(facts());
            say_how_to_continue(session, plan, stop);
        }
        file.close();
    });
    parallel::on_root(session, [&] { print_of_file(words, plan); });
    return code;
}

}  // namespace peterka
