#include "report/regime_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::Statistics;
using regime::Regime;

std::string regime_line(const Statistics& statistics, Regime regime, const char* name,
                        const std::string& meaning) {
    const std::int64_t cells = statistics.cells_of(regime);
    if (cells == 0) return "";
    return fmt::format("  {:<18}{:>14}{:>9}   {}\n", name, readable_count(cells),
                       readable_share(cells, statistics.counts.cells), meaning);
}

// Why a cell has no regime, or what is left open.
const char* in_words(regime::Status status) {
    using regime::Status;
    switch (status) {
        case Status::verified:
            return "verified";
        case Status::budget:
            return "nothing verified in all the cycles that a cell is given (steady_state.max_cycles), or only "
                   "after more cycles than periods are looked for (steady_state.max_period)";
        case Status::conservative:
            return "nothing dissipates, so nothing settles";
        case Status::too_many_events:
            return "too many contacts in one cycle";
        case Status::not_finite:
            return "numbers grew out of range";
        case Status::solver_failed:
            return "the integrator gave up";
        case Status::rounding:
            return "rounding may decide the label: its errors grew by e^20 or more on the way, or those that "
                   "solver.tolerance allows to 0.02 A0";
        case Status::imprecise:
            return "the peak force may be off by more than is allowed (solver.tolerance)";
        case Status::chaotic_so_far:
            return "chaotic in all the cycles that a cell is given (steady_state.max_cycles), too few in this "
                   "rig to tell chaos from a long transient";
    }
    return "";
}

// With the number of cells for each if there are several reasons.
std::string reasons(std::span<const std::int64_t> cells_by_status) {
    const auto is_there = [](std::int64_t cells) { return cells > 0; };
    const bool are_several = std::ranges::count_if(cells_by_status, is_there) > 1;
    std::string text;
    for (std::size_t status = 0; status < cells_by_status.size(); ++status) {
        if (cells_by_status[status] == 0) continue;
        if (!text.empty()) text += "; ";
        if (are_several) text += readable_count(cells_by_status[status]) + ": ";
        text += in_words(static_cast<regime::Status>(status));
    }
    return text;
}

std::string observed(const findings::Observed& chaos) {
    if (chaos.most == 0) return "filled from chaotic cells around";
    const std::string cycles = chaos.fewest == chaos.most
                                   ? readable_count(chaos.most)
                                   : readable_count(chaos.fewest) + " to " + readable_count(chaos.most);
    return fmt::format("chaotic for the {} cycles that were observed; it may settle later", cycles);
}

// What verification left open.
std::string open_ends(const findings::Counts& counts) {
    std::string text;
    for (std::size_t status = 1; status < counts.open_by_status.size(); ++status) {  // except verified cells
        if (counts.open_by_status[status] == 0) continue;
        text += fmt::format("  in {} cell{}: {}\n", readable_count(counts.open_by_status[status]),
                            counts.open_by_status[status] == 1 ? "" : "s",
                            in_words(static_cast<regime::Status>(status)));
    }
    return text;
}

std::string most_frequent_classes(const Statistics& statistics) {
    using Entry = std::pair<findings::ImpactClass, std::int64_t>;
    constexpr std::size_t shown = 6;
    std::vector<Entry> classes(statistics.periodic_cells.begin(), statistics.periodic_cells.end());
    if (classes.empty()) return "";
    std::ranges::stable_sort(classes, std::ranges::greater{}, &Entry::second);

    std::string text = "  most frequent z: ";
    for (std::size_t i = 0; i < std::min(shown, classes.size()); ++i) {
        const auto& [impact_class, cells] = classes[i];
        text += fmt::format("{}{}/{} {}", i == 0 ? "" : ", ", impact_class.impacts, impact_class.period,
                            readable_share(cells, statistics.counts.cells));
    }
    if (classes.size() > shown) text += fmt::format(" and {} more", classes.size() - shown);
    return text + "\n";
}

}  // namespace

std::string name_of(const MotionClass& motion) {
    switch (motion.regime) {
        case Regime::no_impact:
            return "no impact";
        case Regime::periodic:
            return fmt::format("{}/{}", motion.z.impacts, motion.z.period);
        case Regime::sustained_contact:
            return "sustained contact";
        case Regime::chaotic:
            return "chaotic";
        case Regime::unresolved:
            return "unresolved";
        case Regime::failed:
            break;
    }
    return "failed";
}

std::string regimes_in_words(const Statistics& statistics) {
    return "\nWhat the hammer settles into\n" +
           regime_line(statistics, Regime::no_impact, "no impact", "it swings without reaching the stop") +
           regime_line(statistics, Regime::periodic, "periodic",
                       "z = p/q: p impacts in q forcing cycles, for ever") +
           regime_line(statistics, Regime::chaotic, "chaotic", observed(statistics.chaos)) +
           regime_line(statistics, Regime::sustained_contact, "sustained contact", "it stays on the stop") +
           regime_line(statistics, Regime::unresolved, "unresolved",
                       reasons(statistics.counts.unresolved_by_status)) +
           regime_line(statistics, Regime::failed, "failed", reasons(statistics.counts.failed_by_status)) +
           open_ends(statistics.counts) + most_frequent_classes(statistics);
}

std::string transients_in_words(const job::Job& job, const findings::Transients& ends) {
    if (!job.output.has(job::OptionalField::last_impact)) return "";
    if (ends.ended == 0) return "\nNo cell strikes the stop first and ends without impact.\n";
    const double mean = static_cast<double>(ends.cycles) / static_cast<double>(ends.ended);
    const bool refined = job.refine.levels > 0;  // computed cells lie where labels change
    std::string text = fmt::format(
        "\nImpacts that end\n  {}{} without impact after {:.4g} cycles with impacts on "
        "average, {} at most\n  {}still impacting after",
        readable_count(ends.ended),
        ends.ended == 1 ? " cell ends" : (refined ? " computed cells end" : " cells end"), mean,
        readable_count(ends.longest),
        refined ? fmt::format("of the {} computed cells that settled, not of the plane, ",
                              readable_count(ends.cells))
                : "");
    const char* separator = " ";
    for (std::size_t n = 0; n < findings::Transients::looks.size(); ++n) {
        const std::int64_t look = findings::Transients::looks[n];
        if (look >= job.steady_state.max_cycles) break;
        text += fmt::format("{}{} cycles: {}", separator, readable_count(look),
                            readable_share(ends.impacting[n], ends.cells));
        separator = ", ";
    }
    return text + "\n";
}

}  // namespace peterka
