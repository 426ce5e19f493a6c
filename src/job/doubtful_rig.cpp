#include "job/doubtful_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "job/cell_numbers.hpp"
#include "job/derived.hpp"

namespace peterka::job {
namespace {

using Cells = std::vector<CellNumbers>;

// The least doubtful of all cells.
template <class Number>
double smallest(const Cells& cells, Number number) {
    return number(*std::ranges::min_element(cells, {}, number));
}
template <class Number>
double largest(const Cells& cells, Number number) {
    return number(*std::ranges::max_element(cells, {}, number));
}

bool add_mass(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double heavy_kg = 100;
    const double mass = smallest(cells, [](const CellNumbers& cell) { return cell.hammer.mass_kg; });
    if (mass < heavy_kg) return false;
    texts.push_back(
        fmt::format("the hammer's mass is {:.4g} kg: masses are in kilograms, {:.4g} g would be {:.4g} kg",
                    mass, mass, mass / 1000));
    return true;
}

void add_natural_frequency(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double slow_hz = 0.5;  // springs that sag by a metre under the hammer's weight
    const auto frequency = [](const CellNumbers& cell) { return natural_frequency_hz(cell.hammer); };
    const double highest = largest(cells, frequency);
    if (highest >= slow_hz) return;
    const Hammer& hammer = std::ranges::max_element(cells, {}, frequency)->hammer;
    const std::string unit =
        hammer.stiffness_n_per_m
            ? fmt::format("stiffnesses are in N/m, {0:.4g} N/mm would be {1:.4g} N/m",
                          *hammer.stiffness_n_per_m, *hammer.stiffness_n_per_m * 1000)
            : fmt::format("frequencies are in hertz, {:.4g} kHz would be {:.4g} Hz", highest, highest * 1000);
    texts.push_back(fmt::format(
        "the hammer's natural frequency is {:.4g} Hz, on springs too soft to carry it: {}", highest, unit));
}

void add_damping(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double strong = 0.3;  // beam springs have hundredths or less
    const auto ratio = [](const CellNumbers& cell) { return derive(cell.hammer).zeta; };
    const double zeta = smallest(cells, ratio);
    if (zeta < strong) return;
    const Hammer& hammer = std::ranges::min_element(cells, {}, ratio)->hammer;
    texts.push_back(
        hammer.damping_ratio
            ? fmt::format("the hammer's damping ratio is {0:.4g}: it is a share of critical damping, not a "
                          "percentage, {0:.4g} % would be {1:.4g}",
                          zeta, zeta / 100)
            : fmt::format("the hammer's damping of {:.4g} Ns/m is a damping ratio of {:.3g}: dampings are in "
                          "Ns/m, and those of beam springs are hundredths of the critical one or less",
                          hammer.damping(), zeta));
}

void add_cubic(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double amplitudes = 10;
    constexpr double nothing = 1e-8;  // of the springs' force
    const auto share = [](const CellNumbers& cell) {
        return std::abs(cell.hammer.cubic_stiffness_n_per_m3) / cell.hammer.stiffness() *
               std::pow(amplitudes * cell.cart.amplitude_m, 2);
    };
    const double of_force = largest(cells, share);
    if (of_force == 0 || of_force >= nothing) return;
    const double cubic = std::ranges::max_element(cells, {}, share)->hammer.cubic_stiffness_n_per_m3;
    texts.push_back(
        fmt::format("the springs' cubic term changes their force by {0:.1g} of it at {1:g} amplitudes of the "
                    "cart: cubic stiffnesses are in N/m^3, {2:.4g} N/mm^3 would be {3:.4g} N/m^3",
                    of_force, amplitudes, cubic, cubic * 1e9));
}

// Of the stop over the springs, at a penetration of an amplitude.
double stiffness_over_springs(const CellNumbers& cell) {
    if (const auto* stop = std::get_if<KelvinVoigt>(&cell.contact)) return derive(*stop, cell.hammer).kappa;
    if (const auto* stop = std::get_if<HuntCrossley>(&cell.contact))
        return derive(*stop, cell.hammer, cell.cart).stiffness;
    return std::numeric_limits<double>::infinity();
}

bool add_stiffness_of_stop(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double soft = 100;  // where a stop is one, it is thousands of times as stiff as beam springs
    const double ratio = largest(cells, stiffness_over_springs);
    if (ratio >= soft) return false;
    const Contact& contact = std::ranges::max_element(cells, {}, stiffness_over_springs)->contact;
    const auto* linear = std::get_if<KelvinVoigt>(&contact);
    texts.push_back(fmt::format(
        "the stop is only {:.3g} times as stiff as the beam springs{}: {}", ratio,
        linear == nullptr ? " at a penetration of the cart's amplitude" : "",
        linear == nullptr ? "its stiffness is in N/m^n, to which one in N/mm^n is converted by 1000^n"
                          : fmt::format("stiffnesses are in N/m, {:.4g} N/mm would be {:.4g} N/m",
                                        linear->stiffness_n_per_m, linear->stiffness_n_per_m * 1000)));
    return true;
}

// Of the damping of the hammer against its stop; 1 is critical. D A0 omega / 2 where it grows with penetration.
double damping_of_stop(const CellNumbers& cell) {
    if (const auto* stop = std::get_if<KelvinVoigt>(&cell.contact))
        return stop->damping_ns_per_m / (2 * std::sqrt(stop->stiffness_n_per_m * cell.hammer.mass_kg));
    if (const auto* stop = std::get_if<HuntCrossley>(&cell.contact))
        return derive(*stop, cell.hammer, cell.cart).dissipation / 2;
    return 0;
}

void add_damping_of_stop(const Cells& cells, std::vector<std::string>& texts) {
    constexpr double weak = 1e-3;  // takes a third of a percent of the speed
    constexpr double strong = 10;  // a stop that creeps back after the hammer has left
    const double most = largest(cells, damping_of_stop);
    const double least = smallest(cells, damping_of_stop);
    const bool is_weak = most > 0 && most < weak;
    if (!is_weak && least < strong) return;
    const Contact& contact = std::ranges::max_element(cells, {}, damping_of_stop)->contact;
    const auto* nonlinear = std::get_if<HuntCrossley>(&contact);
    const double given =
        nonlinear != nullptr ? nonlinear->dissipation_s_per_m : std::get<KelvinVoigt>(contact).damping_ns_per_m;
    const std::string_view unit = nonlinear != nullptr ? "s/m" : "Ns/m";
    const std::string_view other = nonlinear != nullptr ? "s/mm" : "Ns/mm";
    texts.push_back(
        is_weak ? fmt::format("the stop's damping is {0:.2g} of the critical one and takes hardly anything: it "
                              "is in {1}, {2:.4g} {3} would be {4:.4g} {1}",
                              most, unit, given, other, given * 1000)
                : fmt::format(
                      "the stop's damping is {:.3g} times the critical one: it is in {}, its stiffness in N/m",
                      least, unit));
}

}  // namespace

void add_doubtful_rig(const Job& job, std::vector<std::string>& texts) {
    const Cells cells = numbers_at_corners(job);
    if (add_mass(cells, texts)) return;  // what is derived from it is as doubtful
    add_natural_frequency(cells, texts);
    add_damping(cells, texts);
    add_cubic(cells, texts);
    // a stop that is too soft is overdamped, too
    if (!add_stiffness_of_stop(cells, texts)) add_damping_of_stop(cells, texts);
}

}  // namespace peterka::job
