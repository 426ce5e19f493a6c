#include "run/commands.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <variant>

#include "job/names.hpp"
#include "map_file/provenance.hpp"
#include "map_file/whole_file.hpp"
#include "parallel/collective.hpp"
#include "report/closing_lines.hpp"
#include "run/solve_tasks.hpp"
#include "run/words.hpp"
#include "study/topic.hpp"
#include "support/readable.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

using parallel::Session;

constexpr std::int64_t largest_study = 10'000'000;  // far above any observed [bytes]

std::string closing_words(const Session& session, const RunPlan& plan, const Stopwatch& wall) {
    return fmt::format("\nThis run: {} on {} {}\n{}", readable_duration(wall.seconds()), session.size(),
                       session.size() == 1 ? "rank" : "ranks", closing_lines("Study file", plan.file));
}

// Computing the references for the comparison takes a while, too.
std::optional<study::AnyTopic> make_topic(const Session& session, const RunPlan& plan) {
    std::optional<study::AnyTopic> topic;
    parallel::together(session.communicator(), [&] { topic.emplace(study::make_topic(plan.job)); });
    return topic;
}

// Returns the text to print.
template <study::Topic Topic>
std::string run_topic(const Session& session, const RunPlan& plan, const Topic& topic,
                      const StopRequest& stop) {
    const Stopwatch wall;
    const auto results = solve_tasks(session, plan, topic, stop);
    const map_file::RunFacts facts{session.size(), wall.seconds(), host_names(session, plan)};
    if (!session.is_root()) return "";
    map_file::write_whole_file(
        plan.file, plan.job, map_file::collect_provenance(),
        {{{"topic", std::string(job::name(plan.job.study.topic))}}, topic.tables(results)}, facts);
    if (plan.quiet) return "";
    return fmt::format("\n{}\n{}{}", plan.job.title.empty() ? "(no title)" : plan.job.title,
                       topic.summary(results), closing_words(session, plan, wall));
}

}  // namespace

ExitCode run_study(const Session& session, const RunPlan& plan) {
    if (plan.existing == map_file::Existing::complete) {
        parallel::on_root(session, [&] { print_complete(plan); });
        return ExitCode::done;
    }
    parallel::on_root(session, [&] { map_file::require_place(plan.file, largest_study); });
    const StopRequest stop(plan.max_wall_seconds);
    ExitCode code = ExitCode::done;
    std::string words;
    parallel::failing_ends_all(session, [&] {
        try {
            const auto topic = make_topic(session, plan);
            words = std::visit([&](const auto& each) { return run_topic(session, plan, each, stop); }, *topic);
        } catch (const Stopped&) {
            code = ExitCode::stopped_early;  // all ranks come here together
        }
    });
    if (code == ExitCode::stopped_early && session.is_root()) {
        tell(
            "peterka: stopped early ({}); a study keeps nothing of an unfinished run: the same command starts "
            "over\n",
            stop.reason());
    }
    parallel::on_root(session, [&] { print_of_file(words, plan); });
    return code;
}

}  // namespace peterka
