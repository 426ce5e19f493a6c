#include "run_study.hpp"

#include <fmt/format.h>

#include <string>

#include "job/names.hpp"
#include "output/provenance.hpp"
#include "output/whole_file.hpp"
#include "parallel/hosts.hpp"
#include "program/solve_tasks.hpp"
#include "study/topic.hpp"
#include "support/print.hpp"
#include "support/readable.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using parallel::Session;

constexpr std::int64_t largest_study = 10'000'000;  // far above any [bytes]

std::string closing_words(const Session& session, const RunPlan& plan, const Stopwatch& wall) {
    const std::string file = plan.file.string();
    return fmt::format("\nThis run: {} on {} {}\nStudy file {}\nDraw it    postprocess/draw.py {}\n",
                       readable_duration(wall.seconds()), session.size(),
                       session.size() == 1 ? "rank" : "ranks", file, file);
}

template <study::Topic Topic>
ExitCode run_topic(const Session& session, const RunPlan& plan, const Topic& topic) {
    const Stopwatch wall;
    const StopRequest stop(plan.max_wall_seconds);
    const auto results = solve_tasks(session, plan, topic, stop);
    const output::RunFacts facts{session.size(), wall.seconds(), parallel::host_names(session)};
    if (!session.is_root()) return results ? ExitCode::done : ExitCode::stopped_early;
    if (!results) {
        tell(
            "peterka: stopped early ({}); a study keeps nothing of an unfinished run: the same command starts "
            "over\n",
            stop.reason());
        return ExitCode::stopped_early;
    }
    output::write_whole_file(
        plan.file, plan.job, output::collect_provenance(),
        {{{"topic", std::string(job::name(plan.job.study.topic))}}, topic.tables(*results)}, facts);
    if (!plan.quiet) {
        print(fmt::format("\n{}\n{}{}", plan.job.title.empty() ? "(no title)" : plan.job.title,
                          topic.summary(*results), closing_words(session, plan, wall)));
    }
    return ExitCode::done;
}

}  // namespace

ExitCode run_study(const Session& session, const RunPlan& plan) {
    if (plan.existing == output::Existing::complete) {
        if (session.is_root() && !plan.quiet) {
            print(fmt::format("{} is complete: nothing is computed\n", plan.file.string()));
        }
        return ExitCode::done;
    }
    parallel::on_root(session, [&] { output::require_place(plan.file, largest_study); });
    ExitCode code = ExitCode::stopped_early;
    parallel::failing_ends_all(session, [&] {
        code = std::visit([&](const auto& topic) { return run_topic(session, plan, topic); },
                          study::make_topic(plan.job));
    });
    return code;
}

}  // namespace peterka
