#include "report/axis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/twins.hpp"
#include "scene/scales.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

double natural_hz(const scene::Scales& scales) {
    return scales.frequency_rad_per_s / (2 * std::numbers::pi);
}

// Lengths in millimetres.
std::string with_unit(std::string_view key, double value, int digits) {
    const std::string& units = job::quantity(key).units;
    if (units == "m") return fmt::format("{:.{}g} mm", 1e3 * value, digits);
    const std::string number = fmt::format("{:.{}g}", value, digits);
    return units == "1" ? number : fmt::format("{} {}", number, units);
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

std::string place(const job::Job& job, double frequency, double gap, const scene::Scales& scales) {
    return fmt::format("{}, {}", frequency_in_words(job, frequency, frequency * natural_hz(scales)),
                       gap_in_words(job, gap, gap * scales.length_m));
}

}  // namespace

std::string place_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    const scene::Cell cell = scene.cell(row, column);
    std::string text = place(job, cell.oscillator.frequency, cell.oscillator.gap, cell.scales);
    text += number_in_words(scene, column_key(job), job::axis_value(job.columns, column));
    if (job.kind != job::Kind::sweep)
        text += number_in_words(scene, row_key(job), job::axis_value(job.rows, row));
    return text;
}

std::string place_in_words(const job::Job& job) {
    return place(job, job.operating_point.frequency_ratio, job.operating_point.gap_ratio,
                 scene::scales_of(job));
}

std::string frequency_in_words(const job::Job& job, double ratio, double hertz) {
    return job::leads_in_si(job, "frequency_hz")
               ? fmt::format("frequency {:.6g} Hz (Omega/omega {:.6g})", hertz, ratio)
               : fmt::format("Omega/omega {:.6g} ({:.6g} Hz)", ratio, hertz);
}

std::string gap_in_words(const job::Job& job, double ratio, double metres) {
    return job::leads_in_si(job, "gap_m") ? fmt::format("gap {:.6g} mm (gap/A0 {:.6g})", 1e3 * metres, ratio)
                                          : fmt::format("gap/A0 {:.6g} ({:.4g} mm)", ratio, 1e3 * metres);
}

std::string short_force_in_words(const job::Job& job, double ratio, double weight, int digits) {
    return job::leads_in_si(job) ? readable_amount(ratio * weight, "N", digits)
                                 : fmt::format("{:.{}g} weights", ratio, digits);
}

std::string force_in_words(const job::Job& job, double ratio, double weight, int digits) {
    const std::string weights = fmt::format("{:.{}g} weights", ratio, digits);
    const std::string newton = readable_amount(ratio * weight, "N", digits);
    return job::leads_in_si(job) ? newton + " = " + weights : weights + " = " + newton;
}

std::string start_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    const auto said = [&](std::string_view key, const job::Axis& axis, std::int64_t index) {
        return fmt::format("{} {}", label_in_words(key),
                           value_in_words(scene, key, job::axis_value(axis, index)));
    };
    return fmt::format("{}, {}", said(column_key(job), job.columns, column), said(row_key(job), job.rows, row));
}

std::string value_in_words(const scene::Scene& scene, std::string_view key, double value, int digits) {
    const auto twin = twin_on_axis(scene.job(), key);
    if (!twin || job::is_in_si(key)) return with_unit(key, value, digits);
    return fmt::format("{:.{}g} ({})", value, digits, with_unit(twin->key, twin->value(value), digits));
}

int digits_apart(const job::Axis& axis) {
    constexpr int fewest = 4;
    constexpr int most = 12;
    const std::vector<double> values = job::axis_values(axis);
    double least = 1;  // difference of neighbours, relative to the larger
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double larger = std::max(std::abs(values[i]), std::abs(values[i - 1]));
        least = std::min(least, std::abs(values[i] - values[i - 1]) / larger);
    }
    // the last of d digits is worth 10^(1 - d) of a number at most
    return std::clamp(static_cast<int>(std::ceil(1 - std::log10(least / 2))), fewest, most);
}

std::string label_in_words(std::string_view key) {
    if (job::is_frequency(key)) return job::is_in_si(key) ? "frequency" : "Omega/omega";
    if (job::is_gap(key)) return job::is_in_si(key) ? "gap" : "gap/A0";
    if (job::is_displacement(key)) return job::is_in_si(key) ? "x" : "x/A0";
    if (job::is_velocity(key)) return job::is_in_si(key) ? "x'" : "x'/(A0 omega)";
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
