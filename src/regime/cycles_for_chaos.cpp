#include "regime/cycles_for_chaos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regime/chaos_claim.hpp"

namespace peterka::regime {

namespace {

// The stop's force returns to 0 after 2 arccos(D)/sqrt(1 - D^2) in units of the inverse contact frequency, D
// being the contact's damping ratio (eq. 10 of Aguiar & Weber without a dead load); for D > 1 in hyperbolic
// functions.
double loss_of_an_impact(double damping_ratio, const scene::KelvinVoigt<double>& stop) {
    const double frequency = std::sqrt(1 + stop.stiffness);
    const double ratio = (2 * damping_ratio + stop.damping) / (2 * frequency);
    const double square = 1 - ratio * ratio;
    if (std::abs(square) < 1e-6) return 2 * stop.damping / frequency;  // the limit of both
    const double angle = square > 0 ? std::acos(ratio) : std::acosh(ratio);
    return stop.damping * 2 * angle / std::sqrt(std::abs(square)) / frequency;
}
double loss_of_an_impact(double /*damping_ratio*/, const scene::Restitution<double>& stop) {
    return -2 * std::log(stop.coefficient);
}
double loss_of_an_impact(double /*damping_ratio*/, const scene::HuntCrossley<double>& /*stop*/) {
    return 0;
}

std::int64_t rounded_up(double cycles) {
    const double unit = std::pow(10, std::max(std::floor(std::log10(cycles)) - 1, 0.0));
    return static_cast<std::int64_t>(std::ceil(cycles / unit) * unit);
}

}  // namespace

double loss_of_a_cycle(const scene::Oscillator<double>& oscillator, double impacts) {
    const double in_flight = 2 * oscillator.damping_ratio * oscillator.period();
    if (!(impacts > 0)) return in_flight;
    return in_flight +
           impacts *
               std::visit([&](const auto& stop) { return loss_of_an_impact(oscillator.damping_ratio, stop); },
                          oscillator.contact);
}

std::int64_t cycles_for_chaos(const scene::Oscillator<double>& oscillator, const job::SteadyState& budget,
                              double impacts) {
    constexpr double most = 2e9;  // largest max_cycles, for very weak dissipation
    const double cycles = ChaosClaim::most_cycles(budget, loss_of_a_cycle(oscillator, impacts));
    return rounded_up(std::min(cycles + Growth::block_cycles, most));  // chaos is tested block by block
}

}  // namespace peterka::regime
