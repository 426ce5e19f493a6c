#include "trace/impacts.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::trace {

void Impacts::touch(double speed) {
    lasts_ = now() < length_;
    if (lasts_) impacts_.push_back({.time = now(), .speed = speed});
}

void Impacts::leave(const trajectory::ImpactRecord<double>& impact) {
    if (!lasts_) return;
    lasts_ = false;
    impacts_.back().end = now();
    impacts_.back().record = impact;
}

std::optional<std::size_t> Impacts::hardest() const {
    constexpr double equal = 1e-9;  // rounding along an orbit
    std::optional<std::size_t> found;
    const auto hardness = [](const Impact& impact) {
        return std::isnan(impact.record.peak_force) ? impact.speed : impact.record.peak_force;
    };
    const auto is_over = [](const Impact& impact) { return !std::isnan(impact.end); };
    const bool some_are = std::ranges::any_of(impacts_, is_over);
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
        if (some_are && !is_over(impacts_[i])) continue;
        if (!found || hardness(impacts_[i]) > (1 + equal) * hardness(impacts_[*found])) found = i;
    }
    return found;
}

}  // namespace peterka::trace
