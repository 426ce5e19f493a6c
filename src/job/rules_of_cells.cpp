// Rules over what cells have for themselves. Each number is monotonic along an axis, and so the corners of the
// plane tell of all cells.
#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"
#include "job/settle.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {
namespace {

bool has_cells(const Job& job) {
    const bool has_axes = job.kind != Kind::trace && job.kind != Kind::basin;
    return !has_axes || (job.columns.points > 0 && (job.kind == Kind::sweep || job.rows.points > 0));
}

std::string lowest_gap_in_words(const Job& job) {
    if (job.kind == Kind::sweep && !job.sweep.gap_ratio.empty()) return "the lowest sweep.gap_ratio";
    return has_axis(job, is_gap) ? "the lowest axes.gap_ratio" : "the lowest gap_ratio";
}

}  // namespace

std::string rule_of_rigid_stop(const Job& job) {
    if (!is_rigid(job.contact) || !has_rig(job) || !has_cells(job)) return "";
    const auto numbers = numbers_at_corners(job);
    const auto depth = [](const CellNumbers& cell) { return cell.start.displacement_ratio - cell.gap_ratio(); };
    const CellNumbers& deepest = *std::ranges::max_element(numbers, {}, depth);
    return rule_of_rigid_stop(job.contact, "start.displacement_ratio", deepest.start.displacement_ratio,
                              lowest_gap_in_words(job), deepest.gap_ratio());
}

std::string rule_of_room(const Job& job) {
    const std::vector<double>& interval = job.starts.displacement_ratio;
    const bool is_sound = interval.size() == 2 && interval[0] < interval[1];  // else a fault already
    if (job.starts.count == 0 || !is_sound || !has_rig(job) || !has_cells(job)) return "";
    double lowest = std::numeric_limits<double>::infinity();
    for (const CellNumbers& cell : numbers_at_corners(job)) lowest = std::min(lowest, cell.gap_ratio());
    if (interval[0] < lowest) return "";
    return fmt::format(
        "starts.displacement_ratio begins at {}, beyond the stop at {} = {}; the hammer starts in front of the "
        "stop; begin it below {}, or take the stop further away",
        toml_text(interval[0]), lowest_gap_in_words(job), toml_text(lowest), toml_text(lowest));
}

std::string rule_of_place(const Job& job) {
    if (!has_rig(job) || !has_cells(job)) return "";
    for (const CellNumbers& cell : numbers_at_corners(job)) {
        const bool in_hz = cell.place.frequency_hz.has_value();
        if (in_hz && !frequency_ratio.range.contains(cell.frequency_ratio())) {
            return fmt::format("frequency_hz = {} is {:.3g} times the natural frequency; {}; give {} times it",
                               toml_text(*cell.place.frequency_hz), cell.frequency_ratio(),
                               frequency_ratio.range.reason, frequency_ratio.range.text());
        }
        if (cell.place.gap_m && !gap_ratio.range.contains(cell.gap_ratio())) {
            return fmt::format("gap_m = {} is {:.3g} times the cart's amplitude; {}; give {} times it",
                               toml_text(*cell.place.gap_m), cell.gap_ratio(), gap_ratio.range.reason,
                               gap_ratio.range.text());
        }
    }
    return "";
}

}  // namespace peterka::job
