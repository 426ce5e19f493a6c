#include "regime/observation.hpp"

#include <cmath>
#include <cstddef>

namespace peterka::regime {

void Observation::write_to(CellResult& result) {
    const auto cycles = static_cast<double>(std::max<std::int64_t>(cycles_, 1));
    const trajectory::Totals<double>& totals = recorder_.totals();
    result.peak_force = totals.peak_force();
    write_force_per_cycle(result);
    result.largest_displacement = totals.displacement_bound;
    result.chatter = totals.chatter;
    result.impact_rate = static_cast<double>(totals.impacts) / cycles;
    if (detail_ == trajectory::Detail::force) return;
    result.impact_speed = totals.impact_speed;
    result.impulse = totals.impulse;
    result.contact_time = totals.contact_time;
    result.contact_power = totals.contact_work / (cycles * period_);
    if (detail_ < trajectory::Detail::contacts) return;
    result.max_displacement = totals.largest_displacement;
}

// Mean and 95 % quantile (nearest rank) of the cycles' largest forces.
void Observation::write_force_per_cycle(CellResult& result) {
    if (peaks_.empty()) return;
    const std::size_t cycles = peaks_.size();
    double sum = 0;
    for (const double peak : peaks_) sum += peak;
    const auto rank = peaks_.begin() + static_cast<std::ptrdiff_t>((95 * cycles + 99) / 100 - 1);
    std::ranges::nth_element(peaks_, rank);
    result.peak_force_mean = sum / static_cast<double>(cycles);
    result.peak_force_q95 = std::isnan(sum) ? unknown : *rank;
    result.window_cycles = static_cast<std::int32_t>(cycles);
}

}  // namespace peterka::regime
