#include "job/doubtful_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "job/derived.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

constexpr double most_amplitudes = 100;
constexpr double largest_amplitude_m = 0.1;
constexpr double rad_per_cycle = 2 * std::numbers::pi;

using Cells = std::vector<CellNumbers>;

// Of all starts in this unit: those of the cells, of a basin's axis, and of the rectangle of [starts].
double largest_start(const Job& job, const Cells& cells, std::optional<double> Start::*of_cell,
                     const std::vector<double>& of_rectangle, bool (*is_it)(std::string_view key)) {
    double largest = 0;
    for (const CellNumbers& cell : cells) {
        largest = std::max(largest, std::abs((cell.start.*of_cell).value_or(0)));
    }
    for (const double start : of_rectangle) largest = std::max(largest, std::abs(start));
    if (job.kind != Kind::basin) return largest;
    for (const auto& [key, axis] :
         {std::pair(column_key(job), job.columns), std::pair(row_key(job), job.rows)}) {
        if (is_it(key) && is_in_si(key)) largest = std::max({largest, std::abs(axis.from), std::abs(axis.to)});
    }
    return largest;
}

void add_amplitude(const Job& job, std::vector<std::string>& texts) {
    const double amplitude_m = job.cart.amplitude_m;
    if (amplitude_m < largest_amplitude_m) return;
    texts.push_back(
        fmt::format("the cart's amplitude is {:.4g} m: lengths are in metres, {:.4g} mm would be {:.4g} m",
                    amplitude_m, amplitude_m, amplitude_m / 1000));
}

// length_m: the one furthest away, with its sign.
bool add_length(const char* name, double length_m, double amplitude_m, std::vector<std::string>& texts) {
    const double amplitudes = std::abs(length_m) / amplitude_m;
    if (amplitudes <= most_amplitudes) return false;
    texts.push_back(
        fmt::format("the {} reaches {:.4g} m, {:.0f} amplitudes of the cart: lengths are in metres, {:.4g} mm "
                    "would be {:.4g} m",
                    name, length_m, amplitudes, length_m, length_m / 1000));
    return true;
}

// The gap furthest from 0 of all that are given in metres, those of [curves] among them; 0 if none are.
double furthest_gap_m(const Job& job, const Cells& cells) {
    std::vector<double> gaps = job.curves.gap_m;
    for (const CellNumbers& cell : cells) gaps.push_back(cell.place.gap_m.value_or(0));
    return *std::ranges::max_element(gaps, {}, [](double gap) { return std::abs(gap); });
}

void add_gap_ratio(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double many = 1000;  // amplitudes
    constexpr double few = 0.02;
    double largest = 0;
    for (const CellNumbers& cell : cells) {
        if (cell.place.gap_m) return;
        largest = std::max(largest, std::abs(cell.place.gap_ratio));
    }
    if (largest == 0 || (largest > few && largest <= many)) return;
    texts.push_back(
        fmt::format("gap_ratio reaches {}{:.4g} amplitudes of the cart: it is gap/A0; a gap in metres is gap_m",
                    largest <= few ? "no more than " : "", largest));
}

// A hammer that its springs press against a stiff stop follows the cart for ever where k |gap| > m A0 Omega^2.
void add_pressed_on_stop(const Job& job, const Cells& cells, std::vector<std::string>& texts) {
    constexpr double many = 10;  // times that
    double fastest = 1;
    for (const CellNumbers& cell : cells) fastest = std::max(fastest, cell.frequency_ratio());
    const CellNumbers& hardest = *std::ranges::min_element(cells, {}, &CellNumbers::gap_ratio);
    const double times = -hardest.gap_ratio() / (fastest * fastest);
    if (times <= many) return;
    const double gap_m = hardest.gap_ratio() * hardest.cart.amplitude_m;
    texts.push_back(
        fmt::format("a gap of {:.4g} m presses the hammer on its stop by {:.4g} N, {:.3g} times what takes it "
                    "off at the highest frequency: a negative gap is a precompression{}",
                    gap_m, -gap_m * hardest.hammer.stiffness(), times,
                    leads_in_si(job, "gap_m")
                        ? fmt::format(", and {:.4g} mm of it would be gap_m = {:.4g}", -gap_m, gap_m / 1000)
                        : " in amplitudes of the cart"));
}

void add_frequency(const Job& job, const Cells& cells, std::vector<std::string>& texts) {
    constexpr double far = 20;
    constexpr double low = 0.8;
    const auto ratio = [](const CellNumbers& cell) { return cell.frequency_ratio(); };
    const auto [slowest, fastest] = std::ranges::minmax_element(cells, {}, ratio);
    const double highest = ratio(*fastest);
    const bool is_high = highest >= far || ratio(*slowest) >= rad_per_cycle;
    const bool is_low = highest > 0 && highest < low && has_axis(job, is_frequency);
    if (!fastest->place.frequency_hz) {
        if (!is_high) return;
        texts.push_back(
            fmt::format("frequency_ratio reaches {:.4g}: it is Omega/omega, the excitation over the natural "
                        "frequency of the hammer; a frequency in hertz is frequency_hz",
                        highest));
    } else if (is_high) {
        const double hz = *fastest->place.frequency_hz;
        texts.push_back(
            fmt::format("the excitation frequency reaches {0:.4g} Hz, {1:.3g} times the hammer's natural one: "
                        "frequencies are in hertz, {0:.4g} rad/s would be {2:.4g} Hz",
                        hz, highest, hz / rad_per_cycle));
    } else if (is_low) {
        const double natural = natural_frequency_hz(fastest->hammer);
        texts.push_back(
            fmt::format("no excitation frequency comes near the hammer's natural one of {0:.4g} Hz, the "
                        "highest is {1:.4g} Hz: frequencies are in hertz, {0:.4g} rad/s would be {2:.4g} Hz",
                        natural, *fastest->place.frequency_hz, natural / rad_per_cycle));
    }
}

void add_velocity(const Job& job, const Cells& cells, std::vector<std::string>& texts) {
    const double start =
        largest_start(job, cells, &Start::velocity_m_per_s, job.starts.velocity_m_per_s, is_velocity);
    double cart = 0;  // its largest speed, or that of the hammer swinging as far [m/s]
    for (const CellNumbers& cell : cells) {
        cart = std::max(cart, cell.cart.amplitude_m * rad_per_cycle * natural_frequency_hz(cell.hammer) *
                                  std::max(1.0, cell.frequency_ratio()));
    }
    if (start <= most_amplitudes * cart) return;
    texts.push_back(
        fmt::format("the start's velocity reaches {:.4g} m/s, {:.0f} times that of the cart: velocities are in "
                    "m/s, {:.4g} mm/s would be {:.4g} m/s",
                    start, start / cart, start, start / 1000));
}

void add_times_of_trace(const Job& job, std::vector<std::string>& texts) {
    if (job.kind != Kind::trace) return;
    const double natural = natural_frequency_hz(job.hammer);
    const double window = job.trace.impact_window_s;
    if (window * natural > 1) {
        texts.push_back(
            fmt::format("trace.impact_window_s is {:.4g} s, {:.3g} natural periods of the hammer: times are in "
                        "seconds, {:.4g} ms would be {:.4g} s",
                        window, window * natural, window, window / 1000));
    }
    const double to_hz = job.trace.spectrum_to_hz;
    const double slowest = natural * std::max(1.0, numbers_in(job).frequency_ratio());
    constexpr double most_khz = 100;
    if (to_hz >= std::min(most_khz, 2 * slowest)) return;
    texts.push_back(
        fmt::format("trace.spectrum_to_hz is {:.4g} Hz, and the hammer moves at {:.4g} Hz: frequencies are in "
                    "hertz, {:.4g} kHz would be {:.4g} Hz",
                    to_hz, slowest, to_hz, to_hz * 1000));
}

}  // namespace

void add_doubtful_place(const Job& job, std::vector<std::string>& texts) {
    const Cells cells = numbers_at_corners(job);
    add_amplitude(job, texts);
    const bool is_far = add_length("gap", furthest_gap_m(job, cells), job.cart.amplitude_m, texts);
    if (!is_far) add_pressed_on_stop(job, cells, texts);
    add_gap_ratio(cells, texts);
    const double start_m =
        largest_start(job, cells, &Start::displacement_m, job.starts.displacement_m, is_displacement);
    add_length("start", start_m, job.cart.amplitude_m, texts);
    add_frequency(job, cells, texts);
    add_velocity(job, cells, texts);
    add_times_of_trace(job, texts);
}

}  // namespace peterka::job
