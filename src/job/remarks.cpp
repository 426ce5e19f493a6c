#include "job/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "job/rig_draws.hpp"
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

// Where the job's own numbers are not those that were identified with their covariance. What an axis varies, or
// where each cell lies, is not compared.
void add_other_means(const Job& job, std::vector<std::string>& texts) {
    constexpr double rounding = 1e-6;
    const Covariance& covariance = job.uncertainty.covariance;
    for (std::size_t i = 0; i < std::min(covariance.of.size(), covariance.mean.size()); ++i) {
        const std::string_view key = axis_key_of(covariance.of[i]);
        const bool is_axis = says_the_same(key, column_key(job)) ||
                             (job.kind != Kind::sweep && says_the_same(key, row_key(job)));
        const bool is_in_list = is_gap(key) && !job.sweep.gaps().empty();
        if (is_axis || is_in_list) continue;
        const double own = number_of(numbers_in(job), key);
        const double mean = covariance.mean[i];
        if (std::abs(own - mean) <= rounding * std::max(std::abs(own), std::abs(mean))) continue;
        texts.push_back(
            fmt::format("{} is {:.6g} in the job, and {:.6g} where its uncertainty was identified: rigs are "
                        "drawn around {:.6g}",
                        covariance.of[i], own, mean, own));
    }
}

void add_no_rigs(const Job& job, std::vector<std::string>& texts) {
    const Uncertainty& uncertainty = job.uncertainty;
    if (uncertainty.rigs > 0 || (uncertainty.numbers.empty() && uncertainty.covariance.of.empty())) return;
    texts.emplace_back("[uncertainty] names numbers and draws no rigs: set uncertainty.rigs, such as 64");
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
    add_no_rigs(job, texts);
    if (job.uncertainty.rigs > 0) add_other_means(job, texts);
    return texts;
}

}  // namespace peterka::job
