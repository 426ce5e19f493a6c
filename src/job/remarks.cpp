#include "job/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "job/settle.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

constexpr double most_amplitudes = 100;
constexpr double largest_amplitude_m = 0.1;

// Of all starts: those of the cells, of a basin's axis, and of the rectangle of [starts].
double largest_start_m(const Job& job, double of_corners) {
    double largest = of_corners;
    for (const double start_m : job.starts.displacement_m) largest = std::max(largest, std::abs(start_m));
    if (job.kind != Kind::basin) return largest;
    for (const auto& [key, axis] :
         {std::pair(column_key(job), job.columns), std::pair(row_key(job), job.rows)}) {
        if (is_displacement(key) && is_in_si(key))
            largest = std::max({largest, std::abs(axis.from), std::abs(axis.to)});
    }
    return largest;
}

double largest_of_corners(const Job& job, std::optional<double> (*length_m)(const CellNumbers&)) {
    double largest = 0;
    for (const CellNumbers& corner : numbers_at_corners(job)) {
        largest = std::max(largest, std::abs(length_m(corner).value_or(0)));
    }
    return largest;
}

}  // namespace

std::vector<std::string> remarks(const Job& job) {
    std::vector<std::string> texts;
    if (!has_rig(job) || job.kind == Kind::study) return texts;
    const double amplitude_m = job.cart.amplitude_m;
    if (amplitude_m >= largest_amplitude_m) {
        texts.push_back(
            fmt::format("the cart's amplitude is {:.4g} m: lengths are in metres, {:.4g} mm would be {:.4g} m",
                        amplitude_m, amplitude_m, amplitude_m / 1000));
    }
    const double gap_m = largest_of_corners(job, [](const CellNumbers& cell) { return cell.place.gap_m; });
    const double start_m = largest_start_m(
        job, largest_of_corners(job, [](const CellNumbers& cell) { return cell.start.displacement_m; }));
    for (const auto& [name, length_m] : {std::pair("gap", gap_m), std::pair("start", start_m)}) {
        if (length_m <= most_amplitudes * amplitude_m) continue;
        texts.push_back(
            fmt::format("the {} reaches {:.4g} m, {:.0f} amplitudes of the cart: lengths are in metres, "
                        "{:.4g} mm would be {:.4g} m",
                        name, length_m, length_m / amplitude_m, length_m, length_m / 1000));
    }
    return texts;
}

}  // namespace peterka::job
