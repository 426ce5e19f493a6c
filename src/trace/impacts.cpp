#include "trace/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace peterka::trace {

void Impacts::touch(double speed) {
    lasts_ = now() < length_;
    if (lasts_) impacts_.push_back({.touch = touches_, .time = now(), .speed = speed});
    ++touches_;
}

void Impacts::rest(std::int64_t impacts) {
    const auto of_trace = std::min<std::int64_t>(impacts, std::ssize(impacts_));
    if (of_trace == 0 || now() >= length_) return;
    const auto first = impacts_.end() - of_trace;
    work_before_rest_ = std::accumulate(first, impacts_.end(), 0.0,
                                        [](double sum, const Impact& each) { return sum + each.record.work; });
    impacts_.erase(first + 1, impacts_.end());
    impacts_.back() = {
        .touch = impacts_.back().touch, .time = impacts_.back().time, .speed = impacts_.back().speed};
    lasts_ = true;
}

void Impacts::leave(const trajectory::ImpactRecord<double>& impact) {
    if (!lasts_) return;
    lasts_ = false;
    impacts_.back().end = now();
    impacts_.back().record = impact;
    if (!work_before_rest_) return;
    impacts_.back().record.peak_force = regime::unknown;  // the stop is rigid
    impacts_.back().record.work += *std::exchange(work_before_rest_, std::nullopt);
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
