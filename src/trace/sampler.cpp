#include "trace/sampler.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::trace {

Sampler::Sampler(const scene::Oscillator<double>& oscillator, double length, std::int64_t samples_per_cycle)
    : period_(oscillator.period()), frequency_(oscillator.frequency), per_cycle_(samples_per_cycle) {
    constexpr double rounding = 1e-9;  // of a sample's distance: the last one lies at the end
    const double last = std::floor(length / period_ * static_cast<double>(per_cycle_) + rounding);
    count_ = static_cast<std::size_t>(last) + 1;
    instants_.reserve(count_);
}

double Sampler::next_in_cycle() const {
    const auto in_cycle = static_cast<std::int64_t>(instants_.size()) % per_cycle_;
    return period_ * static_cast<double>(in_cycle) / static_cast<double>(per_cycle_);
}

void Sampler::look(const Stretch& stretch) {
    const std::int64_t cycle = std::llround(stretch.cycle_begin / period_);
    const double end = stretch.from + stretch.length;
    while (instants_.size() < count_ && static_cast<std::int64_t>(instants_.size()) / per_cycle_ == cycle) {
        const double time = next_in_cycle();
        if (!(time < end)) return;
        const double inside = std::max(0.0, time - stretch.from);
        instants_.push_back(
            {stretch.cycle_begin + time, frequency_ * time, stretch.state_at(inside), stretch.phase});
    }
}

void Sampler::finish(const State<double>& end, Phase phase) {
    if (instants_.size() < count_) instants_.push_back({cycle_begin() + period_, 0, end, phase});
}

}  // namespace peterka::trace
