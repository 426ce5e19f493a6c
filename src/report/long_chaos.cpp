#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "regime/cycles_for_chaos.hpp"
#include "support/readable.hpp"

namespace peterka {

namespace {

// Cells with more impacts dissipate more; those of the same row, at another frequency, may dissipate less.
std::int64_t cycles_asked(const scene::Scene& scene, const findings::LongestChaos& longest) {
    std::int64_t cycles = 0;
    for (const std::int64_t column : {std::int64_t{0}, longest.column, scene.columns() - 1}) {
        const scene::Cell cell = scene.cell(longest.row, column);
        cycles = std::max(
            cycles, regime::cycles_for_chaos(cell.oscillator, scene.job().steady_state, longest.impact_rate));
    }
    return cycles;
}

}  // namespace

std::string long_chaos(const scene::Scene& scene, const findings::Statistics& statistics) {
    if (!statistics.longest.found()) return "";
    const std::int64_t now = scene.job().steady_state.max_cycles;
    const std::int64_t cycles = cycles_asked(scene, statistics.longest);
    if (cycles <= now) return "";
    const auto cells =
        statistics.counts.unresolved_by_status[static_cast<std::size_t>(regime::Status::chaotic_so_far)];
    const double seconds_of_a_cycle =
        statistics.tile_seconds / static_cast<double>(std::max<std::int64_t>(statistics.counts.cycles, 1));
    const double most = static_cast<double>(cells) * static_cast<double>(cycles - now) * seconds_of_a_cycle;
    return fmt::format(
        "  chaotic for all {} cycles, and no longer followed: {} cell{}, of a rig that loses so little that\n"
        "  chaos takes up to some {} cycles to be told from a long transient: with steady_state.max_cycles = "
        "{}\n"
        "  they settle or are called chaotic, for some {} of computing more\n",
        readable_count(now), readable_count(cells), cells == 1 ? "" : "s", readable_count(cycles), cycles,
        readable_duration(most));
}

}  // namespace peterka
