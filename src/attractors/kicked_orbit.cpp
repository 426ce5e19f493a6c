#include "attractors/kicked_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace peterka::attractors {

namespace {

scene::Oscillator<double> with_cubic(scene::Oscillator<double> oscillator, double cubic) {
    oscillator.cubic = cubic;
    return oscillator;
}

}  // namespace

KickedOrbit::KickedOrbit(scene::Oscillator<double> oscillator, const regime::FoundAttractor& found)
    : length_(oscillator.period()),
      map_(regime::make_cycle_map(with_cubic(oscillator, found.cubic), found.settings)) {
    Carried point{.state = {found.result.orbit_displacement - oscillator.gap, found.result.orbit_velocity}};
    for (int n = 0; n < found.result.period && point.done(); ++n) {
        points_.push_back(point.state);
        point = carry(point.state, 0, length_);
    }
}

KickedOrbit::Carried KickedOrbit::after(const KickTried& kick) {
    const double cycle = std::clamp(std::floor(kick.phase), 0.0, period() - 1.0);
    const scene::State<double>& point = points_[static_cast<std::size_t>(cycle)];
    const double moment = std::clamp(kick.phase - cycle, 0.0, 1.0) * length_;
    Carried kicked = moment > 0 ? carry(point, 0, moment) : Carried{.state = point};
    if (!kicked.done()) return {.outcome = trajectory::Cycle<double>::Outcome::solver_failed, .state = point};
    kicked.state[1] += kick.change;
    return moment > 0 && moment < length_ ? carry(kicked.state, moment, length_) : kicked;
}

std::optional<scene::State<double>> KickedOrbit::round(const KickTried& kick) {
    const auto cycle = static_cast<int>(std::clamp(std::floor(kick.phase), 0.0, period() - 1.0));
    Carried kicked = after(kick);  // at the end of that cycle, or at its beginning if the kick acts there
    for (int n = kick.phase > cycle ? cycle + 1 : cycle; n < period() && kicked.done(); ++n) {
        kicked = carry(kicked.state, 0, length_);
    }
    if (!kicked.done()) return std::nullopt;
    return kicked.state;
}

KickedOrbit::Carried KickedOrbit::carry(const scene::State<double>& from, double begin, double end) {
    const auto part =
        std::visit([&](auto& map) -> trajectory::Cycle<double> { return map.part(from, begin, end); }, map_);
    return {part.outcome, part.end};
}

}  // namespace peterka::attractors
