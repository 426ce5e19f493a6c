#include "report/trace_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "quantities/fields.hpp"
#include "report/axis_words.hpp"
#include "report/starts_inside.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using quantities::StoredCell;
using regime::Regime;
using scene::Scales;

std::string regime_in_words(const StoredCell& cell) {
    std::string text = cell::regime_names[static_cast<std::size_t>(cell.regime)];
    if (cell.regime == Regime::periodic) text += fmt::format(", z = {}/{}", cell.impacts, cell.period);
    if (cell.status != regime::Status::verified) {
        text += fmt::format(" ({})", cell::status_names[static_cast<std::size_t>(cell.status)]);
    }
    return text;
}

std::string proof_in_words(const StoredCell& cell) {
    if (!std::isnan(cell.multiplier)) return fmt::format(", largest |multiplier| {:.4g}", cell.multiplier);
    if (!std::isnan(cell.lyapunov)) return fmt::format(", Lyapunov exponent {:.3g} per cycle", cell.lyapunov);
    return "";
}

// F/(m g0)
std::string force_in_words(double ratio, const job::Job& job, const Scales& scales) {
    if (std::isnan(ratio)) return job::is_rigid(job.contact) ? "none (the stop is rigid)" : "not known";
    return fmt::format("{}, {:.6g} weights", readable_amount(ratio * scales.weight_n, "N", 6), ratio);
}

std::string place_in_words(const scene::Scene& scene, const trace::Course& course) {
    const job::OperatingPoint& place = scene.job().operating_point;
    const double hertz = scene.scales().frequency_rad_per_s / (2 * std::numbers::pi);
    const double seconds = course.length / scene.scales().frequency_rad_per_s;
    const job::Job& job = scene.job();
    std::string text = place.frequency_ratio > 0
                           ? fmt::format("at {}", frequency_in_words(job, place.frequency_ratio,
                                                                     place.frequency_ratio * hertz))
                           : std::string("with the cart at rest");
    text +=
        fmt::format(", {}, ", gap_in_words(job, place.gap_ratio, place.gap_ratio * scene.scales().length_m));
    if (place.frequency_ratio == 0) return text + fmt::format("{:.4g} s from the start", seconds);
    const std::string from = course.period > 0    ? "the steady state"
                             : course.skipped > 0 ? fmt::format("cycle {} on", course.skipped)
                                                  : "the start";
    return text + fmt::format("{} cycles ({:.4g} s) from {}", scene.job().trace.cycles, seconds, from);
}

std::string cell_in_words(const StoredCell& cell, const scene::Scene& scene) {
    return fmt::format(
        "  regime           {}{}\n"
        "  peak force       {}\n"
        "  decided in       {} forcing cycles, engine {}\n",
        regime_in_words(cell), proof_in_words(cell),
        force_in_words(cell.peak_force, scene.job(), scene.scales()), cell.cycles,
        cell::engine_names[static_cast<std::size_t>(cell.engine)]);
}

std::string impacts_in_words(const trace::Trace& trace, const job::Job& job, const Scales& scales) {
    if (!trace.hardest) return "  impacts          none in the time shown\n";
    const auto& oscillator = trace.course.oscillator;
    const trace::Impact& impact = trace.impacts[trace.hardest->index];
    const double per_omega = 1 / scales.frequency_rad_per_s;
    const double newton = scales.force_n;
    std::string text =
        fmt::format("  impacts          {} in the time shown; the hardest at {:.6g} s, with {:.4g} m/s\n",
                    trace.impacts.size(), impact.time * per_omega,
                    impact.speed * scales.length_m * scales.frequency_rad_per_s);
    if (job::is_rigid(job.contact)) return text;
    if (std::isnan(impact.record.peak_force)) {
        return text +
               "                   the end of the trace cuts its contact: its peak isn't known from here\n";
    }
    text += fmt::format(
        "                   jump at touch {}, peak {} {:.4g} ms later, pressed for {:.4g} ms, "
        "impulse {:.4g} Ns\n",
        readable_amount(trace::force_at_touch(oscillator, impact.speed) * newton, "N"),
        readable_amount(impact.record.peak_force * newton, "N", 6),
        1000 * (trace.hardest->peak.time - impact.time) * per_omega,
        1000 * impact.record.contact_time * per_omega, impact.record.impulse * newton * per_omega);
    return text;
}

// Whether another way of computing may end in another motion.
bool is_left_open(const StoredCell& cell) {
    return cell.regime == Regime::chaotic || cell.regime == Regime::unresolved ||
           cell.status == regime::Status::rounding;
}

std::string map_in_words(const map_file::MapCell& map, const StoredCell& cell) {
    const StoredCell& stored = map.stored;
    const scene::Scene of_map(map.job);
    const auto at = [&](std::string_view key, const job::Axis& axis, std::int64_t index) {
        return fmt::format("{} {}", label_in_words(key),
                           value_in_words(of_map, key, job::axis_value(axis, index), 6));
    };
    std::string text = fmt::format(
        "\n{} {}, row {} ({}), column {} ({})\n"
        "  stores           {}, {}\n",
        map.job.kind == job::Kind::basin ? "Basin" : "Map", map.file.string(), map.row,
        at(row_key(map.job), map.job.rows, map.row), map.column,
        at(column_key(map.job), map.job.columns, map.column), regime_in_words(stored),
        force_in_words(stored.peak_force, map.job, of_map.cell(map.row, map.column).scales));
    if (!map.asked_beside.empty())
        text += fmt::format("                   the nearest cell, {} from the place of this trace\n",
                            map.asked_beside);
    if (!stored.computed) text += "                   filled from the cells around it, not computed\n";
    const bool is_same = regime::same_label(stored, cell);
    if (!map.asked_beside.empty() || (!stored.computed && !is_same))
        return text + fmt::format("  this trace       has {}\n",
                                  is_same ? "the same regime and z" : "another regime or z");
    if (!is_same && (is_left_open(stored) || is_left_open(cell)))
        return text +
               "  this trace       differs in regime or z, as it may where chaos can end or rounding decides\n";
    if (!is_same) return text + "  this trace       DISAGREES in regime or z\n";
    const double off = std::abs(cell.peak_force - stored.peak_force) / std::abs(stored.peak_force);
    return text + fmt::format("  this trace       agrees in regime and z{}\n",
                              std::isfinite(off) ? fmt::format(", peak force off by {:.1e}", off) : "");
}

}  // namespace

std::string trace_in_words(const scene::Scene& scene, const trace::Trace& trace,
                           const std::optional<map_file::MapCell>& map) {
    const Scales& scales = scene.scales();
    const std::string& title = scene.job().title;
    std::string text = fmt::format("\n{}\n\nTrace {}\n", title.empty() ? "(no title)" : title,
                                   place_in_words(scene, trace.course));
    const StoredCell cell = quantities::in_file_units(trace.course.cell.value_or(cell::CellResult{}), scales);
    if (const std::string inside = starts_inside(scene); !inside.empty()) {
        text += fmt::format("  start            {}\n", inside);
    }
    if (trace.course.cell) text += cell_in_words(cell, scene);
    text += impacts_in_words(trace, scene.job(), scales);
    if (map) text += map_in_words(*map, cell);
    return text;
}

}  // namespace peterka
