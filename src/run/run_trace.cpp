#include "run/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

#include "map_file/map_size.hpp"
#include "map_file/provenance.hpp"
#include "map_file/whole_file.hpp"
#include "report/closing_lines.hpp"
#include "report/trace_words.hpp"
#include "run/words.hpp"
#include "support/readable.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"
#include "trace/tables.hpp"

namespace peterka {
namespace {

// Far above what the samples and the spectra take [bytes].
std::int64_t largest_trace(const job::Job& job) {
    constexpr double columns = 12 * sizeof(double);
    const double samples = job::cycles_shown(job) * static_cast<double>(job.trace.samples_per_cycle) +
                           static_cast<double>(job.trace.impact_samples + trace::most_lines);
    return 2'000'000 + static_cast<std::int64_t>(samples * columns);
}

void append(std::vector<map_file::Table>& tables, std::vector<map_file::Table> more) {
    std::ranges::move(more, std::back_inserter(tables));
}

// The path from the trace to its map, so that both can be moved together, revealing no more than that.
std::string from_folder_of(const std::filesystem::path& trace_file, const std::filesystem::path& map_file) {
    return std::filesystem::relative(map_file, map_file::folder_of(trace_file)).string();
}

map_file::Contents contents_of(const scene::Scene& scene, const trace::Trace& trace,
                               const std::optional<map_file::MapCell>& map,
                               const std::filesystem::path& trace_file) {
    map_file::Contents contents{{}, trace::tables_of(trace, scene.scales())};
    if (trace.course.cell) {
        append(contents.tables,
               trace::cell_tables("/cell", quantities::in_file_units(*trace.course.cell, scene.scales()),
                                  trace::with_proofs(scene.job())));
    }
    if (!map) return contents;
    if (!scene.job().output.anonymous)
        contents.texts.push_back({"map_file", from_folder_of(trace_file, map->file)});
    append(contents.tables, trace::cell_tables("/map_cell", map->stored, map->job));
    const auto index = [&](const char* name, std::int64_t value) {
        const hdf5::Variable variable{name, hdf5::Number::int64, -1, "1", "of the cell in its map, from 0"};
        const map_file::DatasetPlan plan{"/map_cell", variable, {}};
        contents.tables.push_back({plan, {static_cast<double>(value)}});
    };
    index("row", map->row);
    index("column", map->column);
    return contents;
}

std::string length_in_words(const job::Job& job) {
    if (job.operating_point.frequency_ratio == 0) return fmt::format("{:.4g} s", job.trace.duration_s);
    return fmt::format("{} forcing cycles", job.trace.cycles);
}

// Returns the text to print.
std::string run_alone(const RunPlan& plan, int ranks, const std::string& hosts) {
    const Stopwatch wall;
    const scene::Scene scene(plan.job);
    if (!plan.quiet) tell("{} to follow\n", length_in_words(plan.job));
    const trace::Trace trace = trace::make_trace(scene);
    map_file::write_whole_file(plan.file, plan.job, map_file::collect_provenance(),
                               contents_of(scene, trace, plan.map_cell, plan.file),
                               {ranks, wall.seconds(), hosts});
    if (plan.quiet) return "";
    return fmt::format("{}\nThis run: {}\n{}", trace_in_words(scene, trace, plan.map_cell),
                       readable_duration(wall.seconds()), closing_lines("Trace file", plan.file));
}

}  // namespace

ExitCode run_trace(const parallel::Session& session, const RunPlan& plan) {
    const StopRequest stop(plan.max_wall_seconds);  // on all ranks: mpirun forwards signals to each
    const std::string hosts = host_names(session, plan);
    parallel::on_root(session, [&] {
        // a cell of a map is followed anew: the map's job is known, but not which file it came from
        if (plan.existing == map_file::Existing::complete && !plan.map_cell) {
            return print_complete(plan);
        }
        map_file::require_place(plan.file, largest_trace(plan.job));
        std::string words;
        try {
            words = run_alone(plan, session.size(), hosts);
        } catch (const Stopped&) {
            throw Failure(
                ExitCode::stopped_early,
                fmt::format("stopped early ({}); a trace keeps nothing of an unfinished run: the same "
                            "command starts over",
                            stop.reason()));
        }
        print_of_file(words, plan);
    });
    return ExitCode::done;
}

}  // namespace peterka
