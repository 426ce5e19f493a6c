// Rules over numbers that differ from cell to cell. Each is monotonic along an axis, so it suffices to check
// the corners of the plane.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"
#include "job/settle.hpp"
#include "job/toml_text.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

bool has_axes(const Job& job) {
    return job.kind != Kind::trace && job.kind != Kind::basin;
}

bool has_cells(const Job& job) {
    return !has_axes(job) || (job.columns.points > 0 && (job.kind == Kind::sweep || job.rows.points > 0));
}

// Names the key of the lowest gap in this unit.
std::string lowest_gap_in_words(const Job& job, std::string_view key) {
    if (!has_axes(job)) return fmt::format("operating_point.{}", key);
    if (!job.sweep.gaps().empty() && job.sweep.gap_key() == key) return fmt::format("the lowest sweep.{}", key);
    const auto is_axis = [&](std::string_view axis) { return axis == key; };
    const bool on_axis = is_axis(column_key(job)) || (job.kind != Kind::sweep && is_axis(row_key(job)));
    return fmt::format("the lowest {}{}", on_axis ? "axes." : "", key);
}

// For a basin, the starts at the ends of its axes.
std::vector<CellNumbers> starts_at_corners(const Job& job) {
    if (job.kind != Kind::basin) return numbers_at_corners(job);
    std::vector<CellNumbers> numbers;
    for (const bool last : {false, true}) {
        CellNumbers start = numbers_in(job);
        set_number(start, column_key(job), last ? job.columns.to : job.columns.from);
        set_number(start, row_key(job), last ? job.rows.to : job.rows.from);
        numbers.push_back(start);
    }
    return numbers;
}

// Whether a start is told in metres: as it is given, and a job's 0, which is the same in both units, as its
// other coordinates are.
bool starts_in_m(const Job& job, const CellNumbers& start) {
    if (start.start.displacement_m || job.kind == Kind::basin) return start.start.displacement_m.has_value();
    return start.displacement_ratio() == 0 && leads_in_si(job);
}

std::string key_of_displacement(const Job& job, bool in_m) {
    if (job.kind == Kind::basin) return fmt::format("axes.{}.to", column_key(job));
    return fmt::format("start.{}", in_m ? displacement_m.name : displacement_ratio.name);
}

std::string out_of_range(std::string_view key, double value, double ratio, std::string_view of_what,
                         const Range<double>& range) {
    return fmt::format("{} = {} is {:.3g} times {}; {}; give {} times it", key, toml_text(value), ratio,
                       of_what, range.reason, range.text());
}

constexpr std::string_view speed_in_words = "the cart's amplitude times omega";

}  // namespace

std::string rule_of_rigid_stop(const Job& job) {
    if (!is_rigid(job.contact) || !has_rig(job) || !has_cells(job)) return "";
    const auto numbers = starts_at_corners(job);
    const auto depth = [](const CellNumbers& cell) { return cell.displacement_ratio() - cell.gap_ratio(); };
    const CellNumbers& deepest = *std::ranges::max_element(numbers, {}, depth);
    const bool in_m = starts_in_m(job, deepest);
    const std::string start = key_of_displacement(job, in_m);
    if (!in_m) {
        return rule_of_rigid_stop(job.contact, start, deepest.displacement_ratio(),
                                  lowest_gap_in_words(job, "gap_ratio"), deepest.gap_ratio());
    }
    const double gap =
        deepest.place.gap_m ? *deepest.place.gap_m : as_twin("gap_ratio", deepest.place.gap_ratio, deepest);
    return rule_of_rigid_stop(job.contact, start, deepest.start.displacement_m.value_or(0),
                              lowest_gap_in_words(job, "gap_m"), gap);
}

std::string rule_of_room(const Job& job) {
    const Starts& starts = job.starts;
    const bool is_given_in_m = !starts.displacement_m.empty();
    std::vector<double> interval = is_given_in_m ? starts.displacement_m : starts.displacement_ratio;
    const bool is_sound = interval.size() == 2 && interval[0] < interval[1];  // otherwise a fault already
    if (starts.count == 0 || !is_sound || !has_rig(job) || !has_cells(job)) return "";
    // the default, which is a ratio, in the job's unit
    const auto twin = shared_twin(job, displacement_ratio.name);
    const bool is_default = interval == Starts{}.displacement_ratio;
    const bool in_m = is_given_in_m || (is_default && twin && leads_in_si(job));
    if (in_m && !is_given_in_m) interval = {twin->value(interval[0]), twin->value(interval[1])};
    double lowest = std::numeric_limits<double>::infinity();
    for (const CellNumbers& cell : numbers_at_corners(job)) {
        const double gap = cell.gap_ratio();
        lowest = std::min(lowest, in_m ? as_twin("gap_ratio", gap, cell) : gap);
    }
    if (interval[0] < lowest) return "";
    return fmt::format(
        "starts.{} begins at {}, beyond the stop at {} = {}; the hammer starts in front of the stop; begin it "
        "below {}, or take the stop further away",
        in_m ? displacement_m.name : displacement_ratio.name, toml_text(interval[0]),
        lowest_gap_in_words(job, in_m ? "gap_m" : "gap_ratio"), toml_text(lowest), toml_text(lowest));
}

std::string rule_of_starts(const Job& job) {
    if (!has_rig(job) || !has_cells(job)) return "";
    for (CellNumbers cell : starts_at_corners(job)) {
        const auto complaint = [&](std::string_view table) -> std::string {
            const auto& [displacement, speed] =
                std::pair(cell.start.displacement_m, cell.start.velocity_m_per_s);
            if (displacement && !displacement_ratio.range.contains(cell.displacement_ratio())) {
                return out_of_range(fmt::format("{}{}", table, displacement_m.name), *displacement,
                                    cell.displacement_ratio(), "the cart's amplitude",
                                    displacement_ratio.range);
            }
            if (speed && !velocity_ratio.range.contains(cell.velocity_ratio())) {
                return out_of_range(fmt::format("{}{}", table, velocity_m_per_s.name), *speed,
                                    cell.velocity_ratio(), speed_in_words, velocity_ratio.range);
            }
            return "";
        };
        if (std::string text = complaint(job.kind == Kind::basin ? "axes." : "start."); !text.empty())
            return text;
        for (const double end : job.starts.displacement_m) {
            cell.start.displacement_m = end;
            if (std::string text = complaint("starts."); !text.empty()) return text;
        }
        for (const double end : job.starts.velocity_m_per_s) {
            cell.start.velocity_m_per_s = end;
            if (std::string text = complaint("starts."); !text.empty()) return text;
        }
    }
    return "";
}

std::string rule_of_place(const Job& job) {
    if (!has_rig(job)) return "";
    std::vector<CellNumbers> cells;
    if (job.kind == Kind::study && job.study.topic == StudyTopic::work_precision) {
        cells = numbers_of_cells(job);
    } else if (has_cells(job)) {
        cells = numbers_at_corners(job);
    }
    for (const CellNumbers& cell : cells) {
        const bool is_at_rest = job.kind == Kind::trace && cell.place.frequency_hz == 0.0;
        if (cell.place.frequency_hz && !is_at_rest && !frequency_ratio.range.contains(cell.frequency_ratio())) {
            return out_of_range("frequency_hz", *cell.place.frequency_hz, cell.frequency_ratio(),
                                "the natural frequency", frequency_ratio.range);
        }
        if (cell.place.gap_m && !gap_ratio.range.contains(cell.gap_ratio())) {
            return out_of_range("gap_m", *cell.place.gap_m, cell.gap_ratio(), "the cart's amplitude",
                                gap_ratio.range);
        }
    }
    return "";
}

}  // namespace peterka::job
