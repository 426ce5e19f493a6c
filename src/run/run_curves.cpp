#include "run/commands.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "curves/search.hpp"
#include "curves/tables.hpp"
#include "curves/words.hpp"
#include "map_file/provenance.hpp"
#include "map_file/whole_file.hpp"
#include "report/closing_lines.hpp"
#include "run/deal_numbers.hpp"
#include "run/price.hpp"
#include "run/progress_style.hpp"
#include "run/words.hpp"
#include "support/progress.hpp"
#include "support/readable.hpp"
#include "support/stop_if_asked.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

std::string omitted_text(const scene::Scene& scene) {
    return scene.cell(0, 0).oscillator.cubic == 0 ? "nothing" : "cubic part of the springs";
}

}  // namespace

ExitCode run_curves(const parallel::Session& session, const RunPlan& plan) {
    if (plan.existing == map_file::Existing::complete) {
        parallel::on_root(session, [&] { print_complete(plan); });
        return ExitCode::done;
    }
    parallel::on_root(session, [&] { map_file::require_place(plan.file, largest_curves_file(plan.job)); });
    const Stopwatch wall;
    const StopRequest stop(plan.max_wall_seconds);
    const std::string hosts = host_names(session, plan);
    ExitCode code = ExitCode::done;
    std::string words;
    const auto find_and_write = [&] {
        const scene::Scene scene(plan.job);
        std::optional<Progress> progress;  // of the stage that has begun
        const auto deal = [&](std::int64_t count, const curves::Task& task, const curves::Done& done) {
            return deal_numbers(session, stop, count, task, done);
        };
        const auto begin = [&](const curves::Stage& stage) {
            const ProgressWork work{.what = stage.what, .noun = stage.noun, .is_kept = false};
            progress.reset();  // ends its line first
            progress.emplace(progress_style(session, plan), stage.count, 0, work);
        };
        const auto found =
            curves::find_curves(scene, deal, {begin, [&](std::int64_t done) { progress->add(done); }});
        progress.reset();
        if (!session.is_root()) return;
        map_file::write_whole_file(plan.file, plan.job, map_file::collect_provenance(),
                                   {{{"omitted", omitted_text(scene)}}, curves::tables_of(scene, found)},
                                   {session.size(), wall.seconds(), hosts});
        if (plan.quiet) return;
        words = fmt::format("{}\n{}This run: {} on {} {}\n{}", curves::in_words(scene, found),
                            curves::speed_in_words(found), readable_duration(wall.seconds()), session.size(),
                            session.size() == 1 ? "rank" : "ranks", closing_lines("Curves file", plan.file));
    };
    parallel::failing_ends_all(session, [&] {
        try {
            find_and_write();
        } catch (const Stopped&) {
            code = ExitCode::stopped_early;  // all ranks come here together
        }
    });
    if (code == ExitCode::stopped_early && session.is_root()) {
        tell(
            "peterka: stopped early ({}); curves keep nothing of an unfinished run: the same command starts "
            "over\n",
            stop.reason());
    }
    parallel::on_root(session, [&] { print_of_file(words, plan); });
    return code;
}

}  // namespace peterka
