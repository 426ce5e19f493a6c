#include "report/omitted.hpp"

#include <fmt/format.h>

#include "job/axis_quantity.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using regime::Engine;

std::int64_t cells_of(const findings::Statistics& statistics, Engine engine) {
    return statistics.counts.by_engine[static_cast<std::size_t>(engine)];
}

// Whose cells keep the cubic spring, e.g. ", kept in 12 cells (split) and 3 (cvode)".
std::string kept_in_words(const findings::Statistics& statistics) {
    std::string text;
    for (const Engine engine : {Engine::split, Engine::cvode, Engine::arkode}) {
        if (cells_of(statistics, engine) == 0) continue;
        text += fmt::format("{} {} ({})", text.empty() ? "; kept in" : " and in",
                            readable_count(cells_of(statistics, engine)),
                            cell::engine_names[static_cast<std::size_t>(engine)]);
    }
    return text;
}

bool has_cubic(const job::Job& job) {
    const auto is_cubic = [](std::string_view key) { return key == "hammer.cubic_stiffness_n_per_m3"; };
    return job.hammer.cubic_stiffness_n_per_m3 != 0 || has_axis(job, is_cubic);
}

std::string cubic_in_words(const job::Job& job, const findings::Statistics& statistics) {
    if (!has_cubic(job)) return "cubic spring: the job has none (k3 = 0)";
    const bool has_speed = job.output.has(cell::OptionalField::impact_speed);
    const char* what = !job::is_rigid(job.contact) ? "the peak force"
                       : has_speed                 ? "the orbit and its impact speed"
                                                   : "the orbit";
    return fmt::format(
        "cubic spring: in {} cells, where it changes no label and {} by less than {:g} of it "
        "(solver.omit_tolerance), or where chaos or rounding decides{}",
        readable_count(cells_of(statistics, Engine::exact)), what, job.solver.omit_tolerance,
        kept_in_words(statistics));
}

}  // namespace

std::vector<std::string> omitted_in_words(const job::Job& job, const findings::Statistics& statistics) {
    std::vector<std::string> sentences;
    const std::int64_t exact = cells_of(statistics, Engine::exact);
    if (exact > 0 || !has_cubic(job)) sentences.push_back(cubic_in_words(job, statistics));
    if (cells_of(statistics, Engine::cvode) + cells_of(statistics, Engine::arkode) == 0) {
        sentences.emplace_back(
            "numerical integration: linear phases are solved in closed form, SUNDIALS is not called");
    }
    if (statistics.counts.filled > 0) {
        sentences.push_back(fmt::format(
            "{}: filled from computed ones of the same regime and z around, see computed",
            statistics.counts.filled == 1 ? "1 cell" : readable_count(statistics.counts.filled) + " cells"));
    }
    sentences.emplace_back("the rest of each trajectory once its regime is verified");
    if (job::is_rigid(job.contact)) return sentences;  // whose forces have no bound
    sentences.emplace_back(
        "peak forces of transients: forces are looked for on orbits that were found, and while chaos is "
        "observed");
    return sentences;
}

}  // namespace peterka
