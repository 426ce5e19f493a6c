#include "curves/inflection.hpp"

#include "curves/reshape.hpp"

namespace peterka::curves {

bool grazing_turns_over(const Rig& rig, const OrbitPoint& here, const OrbitPoint& there) {
    if (!has_same_events(here.orbit, there.orbit)) return false;
    const std::size_t grazing = there.orbit.grazing();
    const Event& event = there.orbit.events[grazing];
    const bool lifted = rig.at(there.place).slope(false, event.time, State<double>::Zero())[1] > 0;
    if (lifted != event.presses) return true;
    // Newton's method may have found the spurious family of orbits whose contact has no duration
    constexpr double nothing = 1e-9;  // of the orbit's duration
    const double duration = rig.at(there.place).duration_of(there.orbit.period);
    return event.presses && there.orbit.length_of_leg(grazing, duration) < nothing * duration;
}

std::optional<OrbitPoint> with_brief_grazing(const OrbitPoint& point) {
    OrbitPoint brief = point;
    std::vector<Event>& events = brief.orbit.events;
    const std::size_t grazing = brief.orbit.grazing();
    if (!events[grazing].presses) return brief;
    const std::size_t next = (grazing + 1) % events.size();
    if (events[next].kind != EventKind::release) return std::nullopt;
    events[grazing].presses = false;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(next));
    return brief;
}

}  // namespace peterka::curves
