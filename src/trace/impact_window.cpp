#include "trace/impact_window.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::trace {

WindowPlan plan_window(std::size_t touch, double touch_time, double width, double share_before,
                       std::int64_t samples, double trace_length) {
    const double step = width / static_cast<double>(samples - 1);
    const auto steps_in = [&](double time) { return static_cast<std::int64_t>(std::floor(time / step)); };
    const auto before = static_cast<std::int64_t>(share_before * static_cast<double>(samples - 1));
    return {.touch = touch,
            .touch_time = touch_time,
            .step = step,
            .before = std::min(before, steps_in(touch_time)),
            .after = std::min(samples - before, steps_in(trace_length - touch_time) + 1)};
}

void ImpactWindow::touch(double /*speed*/) {
    lasts_ = touches_++ == plan_.touch;
}

void ImpactWindow::leave(const trajectory::ImpactRecord<double>& /*impact*/) {
    lasts_ = false;
}

Instant ImpactWindow::instant(const Stretch& stretch, double time) const {
    return {stretch.begin + time, oscillator_.frequency * (stretch.from + time), stretch.state_at(time),
            stretch.phase};
}

void ImpactWindow::look(const Stretch& stretch) {
    sample(stretch);
    if (lasts_ && stretch.phase == Phase::contact) raise_peak(stretch);
}

void ImpactWindow::sample(const Stretch& stretch) {
    const bool has_touched = touches_ > plan_.touch;
    while (std::ssize(instants_) < plan_.before + plan_.after) {
        const std::int64_t from_touch = std::ssize(instants_) - plan_.before;
        if (from_touch >= 0 && !has_touched) return;  // regardless of rounding in the times
        const double time = plan_.touch_time + plan_.step * static_cast<double>(from_touch);
        if (!(time < stretch.end())) return;
        instants_.push_back(instant(stretch, std::clamp(time - stretch.begin, 0.0, stretch.length)));
    }
}

// First the largest value on a grid, then the zero of the slope next to it.
void ImpactWindow::raise_peak(const Stretch& stretch) {
    constexpr int pieces = 256;
    const auto force = [&](double time) { return quantities(oscillator_, instant(stretch, time)).force; };
    const auto grid = [&](int n) { return stretch.length * n / pieces; };
    int top = 0;
    for (int n = 1; n <= pieces; ++n) {
        if (force(grid(n)) > force(grid(top))) top = n;
    }
    double rising = grid(std::max(top - 1, 0));
    double falling = grid(std::min(top + 1, pieces));
    const auto rises = [&](double time) { return force_slope(oscillator_, instant(stretch, time)) > 0; };
    double time = grid(top);
    if (rises(rising) && !rises(falling)) {
        for (int halving = 0; halving < 60; ++halving) {
            time = (rising + falling) / 2;
            (rises(time) ? rising : falling) = time;
        }
    }
    if (force(time) <= largest_) return;
    largest_ = force(time);
    peak_ = instant(stretch, time);
}

}  // namespace peterka::trace
