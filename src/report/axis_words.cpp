#include "report/axis_words.hpp"

#include <fmt/format.h>

#include <numbers>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"

namespace peterka {
namespace {

double natural_hz(const scene::Scales& scales) {
    return scales.frequency_rad_per_s / (2 * std::numbers::pi);
}

std::string with_unit(std::string_view key, double value) {
    const std::string& units = job::quantity(key).units;
    return units == "1" ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, units);
}

std::string number_in_words(std::string_view key, double value) {
    if (job::is_frequency(key) || job::is_gap(key)) return "";
    return fmt::format(", {} {}", label_in_words(key), with_unit(key, value));
}

}  // namespace

std::string place_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    const scene::Cell cell = scene.cell(row, column);
    const double frequency = cell.oscillator.frequency;
    const double gap = cell.oscillator.gap;
    std::string text = fmt::format("Omega/omega {:.4g} ({:.4g} Hz), gap/A0 {:.4g} ({:.3g} mm)", frequency,
                                   frequency * natural_hz(cell.scales), gap, gap * cell.scales.length_m * 1e3);
    text += number_in_words(column_key(job), job::axis_value(job.columns, column));
    if (job.kind != job::Kind::sweep) text += number_in_words(row_key(job), job::axis_value(job.rows, row));
    return text;
}

std::string value_in_words(const scene::Scene& scene, std::string_view key, double value) {
    if (key == "frequency_ratio" && !has_axis(scene.job(), job::is_of_rig))
        return fmt::format("{:.4g} ({:.4g} Hz)", value, value * natural_hz(scene.scales()));
    return with_unit(key, value);
}

std::string label_in_words(std::string_view key) {
    if (key == "frequency_ratio") return "Omega/omega";
    if (key == "gap_ratio") return "gap/A0";
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
