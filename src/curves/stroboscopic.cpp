#include "curves/stroboscopic.hpp"

#include <cmath>

namespace peterka::curves {

std::vector<Stroboscopic> stroboscopic_states(const Rig& rigs, const OrbitPoint& point) {
    const PlacedRig rig = rigs.at(point.place);
    const std::vector<Event>& events = point.orbit.events;
    const double cycle = rig.duration_of(1);
    const double first = std::ceil(events.front().time / cycle);
    std::vector<Stroboscopic> states;
    std::size_t leg = 0;
    for (std::int64_t i = 0; i < point.orbit.period; ++i) {
        const double time = cycle * (first + static_cast<double>(i));
        while (leg + 1 < events.size() && events[leg + 1].time <= time) ++leg;
        const Event& event = events[leg];
        states.push_back({rig.state_in_leg(event.presses, event.time, rig.departure(event), time), time});
    }
    return states;
}

}  // namespace peterka::curves
