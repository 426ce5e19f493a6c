// Rules over the input of curves: the plane, its rig, and the gaps at which borders are reported.
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/rules.hpp"
#include "job/toml_text.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

std::string rule_of_gaps_on_curves(const Job& job) {
    const Curves& curves = job.curves;
    const bool in_columns = is_gap(column_key(job));
    if (!in_columns && !is_gap(row_key(job))) {
        return fmt::format(
            "curves.{} asks where curves have these gaps, and no axis runs over the gap: all cells have the "
            "one of operating_point; remove it",
            curves.gap_key());
    }
    const Axis& axis = in_columns ? job.columns : job.rows;
    const std::string_view key = in_columns ? column_key(job) : row_key(job);
    const auto twin = in_columns ? twin_of_columns(job) : twin_of_rows(job);
    if (curves.gap_key() != key && !twin) {
        return fmt::format(
            "curves.{} is another number in each cell, for the cart's amplitude is an axis and the other one "
            "is {}; give curves.{}",
            curves.gap_key(), key, key);
    }
    for (const double gap : curves.gaps()) {
        const bool same_unit = curves.gap_key() == key;
        const double from = same_unit ? axis.from : twin->value(axis.from);
        const double to = same_unit ? axis.to : twin->value(axis.to);
        if (gap >= from && gap <= to) continue;
        return fmt::format(
            "curves.{} has {}, and the window reaches from {} to {} (axes.{}); no curve is traced there; widen "
            "the window or remove this gap",
            curves.gap_key(), toml_text(gap), toml_text(from), toml_text(to), key);
    }
    return {};
}

}  // namespace

std::string rule_of_curves(const Job& job) {
    if (!has_closed_form(job.contact)) {
        return "curves need contact.law = \"kelvin_voigt\" or \"restitution\"; they rest on the closed form of "
               "the motion, which a nonlinear stop has not; take one of these laws";
    }
    if (is_dashpot_alone(job.contact)) {
        return "contact.stiffness_n_per_m = 0; a dashpot alone never pushes the hammer back, and no impact "
               "ends; give a stiffness";
    }
    const bool keeps_cubic = job.solver.omit_tolerance == 0 && job.hammer.cubic_stiffness_n_per_m3 != 0;
    const EngineChoice engine = job.solver.engine;
    if (keeps_cubic || (engine != EngineChoice::automatic && engine != EngineChoice::exact)) {
        return "curves leave the cubic part of the springs out; they rest on the closed form of the motion, "
               "which those springs have not; leave solver.engine at \"auto\" and solver.omit_tolerance above "
               "0, or set hammer.cubic_stiffness_n_per_m3 to 0";
    }
    return {};
}

std::string rule_of_window(const Job& job) {
    if (job.columns.points < 2 || job.rows.points < 2) {
        return "a window of curves with one point along an axis has no area, and no curve lies in it; give "
               "both axes 2 points or more";
    }
    return job.curves.gaps().empty() ? "" : rule_of_gaps_on_curves(job);
}

std::string rule_of_proved_crossings(const Job& job) {
    if (job.certificate.cells == 0 || !job.curves.gaps().empty()) return {};
    return "certificate.cells asks for proofs, and [curves] names no gap; of curves only the places with such "
           "a gap "
           "are proved; give curves.gap_ratio or curves.gap_m, or remove [certificate]";
}

// Each rank keeps the whole coarse map, and ranks exchange all of it at once: its bytes must be counted in 32
// bits.
std::string rule_of_coarse_map(const Job& job) {
    constexpr std::int64_t most_cells = std::int64_t{2048} * 2048;
    if (job.rows.points <= most_cells / job.columns.points) return {};
    return fmt::format(
        "the axes have {} by {} points; they are a coarse map in which orbits are looked for, which each rank "
        "keeps as a whole, and curves are exact, whatever its cells are; give at most {} points in all",
        job.columns.points, job.rows.points, most_cells);
}

std::string rule_of_borders(const Job& job) {
    if (job.curves.gaps().empty()) return {};
    for (const std::string_view key : {column_key(job), row_key(job)}) {
        if (const std::string_view reason = why_no_curves_over(key); !reason.empty()) {
            return fmt::format("curves.{} asks for borders, which are curves; [axes.{}] {}; remove it",
                               job.curves.gap_key(), key, reason);
        }
    }
    const std::string window = rule_of_window(job);
    return window.empty() ? rule_of_curves(job) : window;
}

}  // namespace peterka::job
