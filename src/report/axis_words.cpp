#include "report/axis_words.hpp"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/twins.hpp"
#include "scene/scales.hpp"

namespace peterka {
namespace {

double natural_hz(const scene::Scales& scales) {
    return scales.frequency_rad_per_s / (2 * std::numbers::pi);
}

std::string with_unit(std::string_view key, double value) {
    const std::string& units = job::quantity(key).units;
    return units == "1" ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, units);
}

// Lengths in millimetres.
std::string in_si(std::string_view key, double value) {
    return job::quantity(key).units == "m" ? fmt::format("{:.4g} mm", 1e3 * value) : with_unit(key, value);
}

// A ratio with its value in SI units.
std::string in_both(const job::Twin& twin, double value) {
    const bool is_ratio = job::is_in_si(twin.key);
    const double other = twin.value(value);
    return is_ratio ? fmt::format("{:.4g} ({})", value, in_si(twin.key, other))
                    : fmt::format("{:.4g} ({})", other, in_si(twin.of, value));
}

std::optional<job::Twin> twin_on_axis(const job::Job& job, std::string_view key) {
    for (const auto& twin : {job::twin_of_columns(job), job::twin_of_rows(job)}) {
        if (twin && twin->of == key) return twin;
    }
    return std::nullopt;
}

std::string number_in_words(const scene::Scene& scene, std::string_view key, double value) {
    if (job::is_frequency(key) || job::is_gap(key)) return "";
    return fmt::format(", {} {}", key, value_in_words(scene, key, value));
}

std::string place(double frequency, double gap, const scene::Scales& scales) {
    return fmt::format("Omega/omega {:.4g} ({:.4g} Hz), gap/A0 {:.4g} ({:.3g} mm)", frequency,
                       frequency * natural_hz(scales), gap, gap * scales.length_m * 1e3);
}

}  // namespace

std::string place_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    const scene::Cell cell = scene.cell(row, column);
    std::string text = place(cell.oscillator.frequency, cell.oscillator.gap, cell.scales);
    text += number_in_words(scene, column_key(job), job::axis_value(job.columns, column));
    if (job.kind != job::Kind::sweep)
        text += number_in_words(scene, row_key(job), job::axis_value(job.rows, row));
    return text;
}

std::string place_in_words(const job::Job& job) {
    return place(job.operating_point.frequency_ratio, job.operating_point.gap_ratio, scene::scales_of(job));
}

std::string start_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    return fmt::format("x/A0 {}, x'/(A0 omega) {}",
                       value_in_words(scene, column_key(job), job::axis_value(job.columns, column)),
                       value_in_words(scene, row_key(job), job::axis_value(job.rows, row)));
}

std::string value_in_words(const scene::Scene& scene, std::string_view key, double value) {
    const auto twin = twin_on_axis(scene.job(), key);
    return twin ? in_both(*twin, value) : with_unit(key, value);
}

std::string label_in_words(const scene::Scene& scene, std::string_view key) {
    const bool has_ratio = !job::is_in_si(key) || twin_on_axis(scene.job(), key);
    if (job::is_frequency(key)) return has_ratio ? "Omega/omega" : "frequency";
    if (job::is_gap(key)) return has_ratio ? "gap/A0" : "gap";
    return std::string(key);
}

std::string plane_in_words(const job::Job& job) {
    const std::string_view columns = column_key(job);
    if (job.kind == job::Kind::sweep) {
        return job::is_frequency(columns) ? "excitation frequencies and branches"
                                          : fmt::format("values of {} and branches", columns);
    }
    if (job::is_frequency(columns) && job::is_gap(row_key(job))) return "excitation frequencies and gaps";
    return fmt::format("values of {} and {}", columns, row_key(job));
}

std::string end_in_words(std::string_view key, bool is_last) {
    if (job::is_frequency(key)) return is_last ? "highest frequency" : "lowest frequency";
    if (job::is_gap(key)) return is_last ? "largest gap" : "smallest gap";
    return fmt::format("{} {}", is_last ? "highest" : "lowest", key);
}

}  // namespace peterka
