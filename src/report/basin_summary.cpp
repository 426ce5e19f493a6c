#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "report/axis_words.hpp"
#include "report/regime_words.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::Attractor;

constexpr std::size_t most_named = 8;

// For a periodic motion: its force, if the law of the stop has one, and its orbit's state at forcing phase 0.
std::string orbit_in_words(const job::Job& job, const quantities::StoredCell& cell,
                           const scene::Scales& scales) {
    if (cell.regime != regime::Regime::periodic) return "";
    const std::string force =
        cell.peak_force > 0
            ? fmt::format("peak force {}, ", force_in_words(job, cell.peak_force, scales.weight_n, 6))
            : "";
    return fmt::format(
        "{}at phase 0 u = {}, u' = {}", force, readable_amount(cell.orbit_displacement * scales.length_m, "m"),
        readable_amount(cell.orbit_velocity * scales.length_m * scales.frequency_rad_per_s, "m/s"));
}

std::string line(const job::Job& job, const Attractor& attractor, const scene::Scales& scales) {
    const std::string orbit = orbit_in_words(job, attractor.cell, scales);
    return fmt::format("  {:<18}{:>14}{:>9}{}{}\n", name_of(motion_class(attractor.cell)),
                       readable_count(attractor.cells), readable_share(attractor.cells, job.cells()),
                       orbit.empty() ? "" : "   ", orbit);
}

}  // namespace

std::string basin_summary(const scene::Scene& scene, std::span<const Attractor> attractors) {
    if (attractors.empty()) return "";
    std::vector<Attractor> by_share(attractors.begin(), attractors.end());
    std::ranges::stable_sort(by_share, std::ranges::greater{}, &Attractor::cells);
    const scene::Scales scales = scene.cell(0, 0).scales;
    std::string text = "\nAttractors, and the starts that lead to each\n";
    for (const Attractor& each : std::span(by_share).first(std::min(most_named, by_share.size()))) {
        text += line(scene.job(), each, scales);
    }
    if (by_share.size() > most_named) text += fmt::format("  and {} more\n", by_share.size() - most_named);
    return text;
}

}  // namespace peterka
