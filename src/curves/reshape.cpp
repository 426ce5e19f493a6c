#include "curves/reshape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "curves/motion_events.hpp"
#include "curves/stroboscopic.hpp"

namespace peterka::curves {

namespace {

using EventPlace = std::vector<Event>::const_iterator;

// Reinserts an orbit's grazing into the events of a simulated motion, which may have a weak impact instead.
bool put_grazing_back(const Event& grazing, double duration, double speed, std::vector<Event>& events) {
    constexpr double weak = 1e-2;  // of the largest speed
    double time = grazing.time;
    while (time < events.front().time) time += duration;
    while (time >= events.front().time + duration) time -= duration;
    const auto near = [&](const Event& event) { return std::abs(event.time - time) < weak * duration; };
    const auto touch = std::ranges::find_if(events, [&](const Event& event) {
        return event.kind == EventKind::touch && std::abs(event.velocity) < weak * speed && near(event);
    });
    if (touch != events.end()) {
        const auto after = touch + 1;
        if (touch->presses && !grazing.presses) {
            if (after == events.end() || after->kind != EventKind::release) return false;
            events.erase(after);
        }
        events.erase(touch);
    }
    Event put = grazing;
    put.time = time;
    const auto place = std::ranges::find_if(events, [&](const Event& event) { return event.time > time; });
    events.insert(place, put);
    return true;
}

}  // namespace

OrbitPoint between(const OrbitPoint& from, const OrbitPoint& to, double share) {
    OrbitPoint point = from;
    const auto mix = [share](double a, double b) { return a + share * (b - a); };
    for (std::size_t i = 0; i < point.orbit.events.size(); ++i) {
        Event& event = point.orbit.events[i];
        event.time = mix(event.time, to.orbit.events[i].time);
        event.velocity = mix(event.velocity, to.orbit.events[i].velocity);
    }
    point.place = {mix(from.place.column, to.place.column), mix(from.place.row, to.place.row)};
    return point;
}

Eigen::VectorXd way_between(const Rig& rig, const OrbitPoint& from, const OrbitPoint& to,
                            const PlanePoint& window) {
    const Unknowns unknowns(from.orbit);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(unknowns.size());
    for (std::size_t i = 0; i < from.orbit.events.size(); ++i) {
        step[unknowns.time(i)] = to.orbit.events[i].time - from.orbit.events[i].time;
        if (from.orbit.events[i].kind == EventKind::graze) continue;
        step[unknowns.velocity(i)] = to.orbit.events[i].velocity - from.orbit.events[i].velocity;
    }
    step[unknowns.column()] = to.place.column - from.place.column;
    step[unknowns.row()] = to.place.row - from.place.row;
    return step.cwiseQuotient(sizes_of_unknowns(rig, from, window));
}

bool has_same_events(const Orbit& a, const Orbit& b) {
    return a.period == b.period && std::ranges::equal(a.events, b.events, {}, &Event::kind, &Event::kind);
}

bool is_same_motion(const Orbit& a, const Orbit& b) {
    const double rounding = 1e-6 * a.largest_speed();
    return has_same_events(a, b) && std::ranges::equal(a.events, b.events, [&](const Event& x, const Event& y) {
               return std::abs(x.velocity - y.velocity) <= rounding;
           });
}

std::optional<OrbitPoint> told_like(const Rig& rig, const OrbitPoint& point, const Orbit& like) {
    const double cycle = rig.at(point.place).duration_of(1);
    std::optional<OrbitPoint> best;
    double nearest = std::numeric_limits<double>::infinity();
    OrbitPoint told = point;
    std::vector<Event>& events = told.orbit.events;
    for (std::size_t turn = 0; turn < point.orbit.events.size(); ++turn) {
        if (has_same_events(told.orbit, like)) {
            const double shift = cycle * std::round((like.events.front().time - events.front().time) / cycle);
            double distance = 0;
            for (std::size_t i = 0; i < events.size(); ++i) {
                events[i].time += shift;
                distance += std::hypot(events[i].time - like.events[i].time,
                                       events[i].velocity - like.events[i].velocity);
            }
            if (distance < nearest) {
                nearest = distance;
                best = told;
            }
        }
        events.front().time += static_cast<double>(point.orbit.period) * cycle;
        std::rotate(events.begin(), events.begin() + 1, events.end());
    }
    return best;
}

OrbitPoint with_grazing(const OrbitPoint& point, const OrbitFault& pierced) {
    OrbitPoint result = point;
    const auto place = result.orbit.events.begin() + static_cast<std::ptrdiff_t>(pierced.event) + 1;
    result.orbit.events.insert(place, {EventKind::graze, false, pierced.time, 0});
    return result;
}

OrbitPoint without_grazing(const OrbitPoint& grazing) {
    OrbitPoint result = grazing;
    std::vector<Event>& events = result.orbit.events;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(result.orbit.grazing()));
    return result;
}

bool is_impact_before_it(const Rig& rig, const OrbitPoint& grazing) {
    constexpr double together = 1e-3;  // of the orbit's duration; solved for, they come as close as 1e-4
    const Orbit& orbit = grazing.orbit;
    const double duration = rig.at(grazing.place).duration_of(orbit.period);
    const std::size_t before = (orbit.grazing() + orbit.events.size() - 1) % orbit.events.size();
    return rig.is_rigid() && orbit.events.size() > 1 &&
           orbit.length_of_leg(before, duration) < together * duration;
}

std::optional<OrbitPoint> grazing_in_place_of(const Rig& rig, const OrbitPoint& point, std::size_t event) {
    OrbitPoint result = point;
    std::vector<Event>& events = result.orbit.events;
    Event& slow = events[event];
    const double pressing = rig.at(point.place).slope(false, slow.time, State<double>::Zero())[1];
    slow.velocity = 0;
    if (pressing > 0) {
        if (rig.is_rigid()) return std::nullopt;  // the hammer sticks to the stop
        slow.kind = EventKind::graze;
        return result;
    }
    if (slow.kind != EventKind::touch) return std::nullopt;
    slow.kind = EventKind::graze;
    if (slow.presses) {
        const std::size_t next = (event + 1) % events.size();
        if (events[next].kind != EventKind::release) return std::nullopt;
        slow.presses = false;
        events.erase(events.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return result;
}

OrbitPoint beyond_grazing(const Rig& rig, const OrbitPoint& grazing, bool gains) {
    OrbitPoint beyond = grazing;
    std::vector<Event>& events = beyond.orbit.events;
    const std::size_t event = grazing.orbit.grazing();
    if (events[event].presses) {
        events[event].kind = gains ? EventKind::touch : EventKind::resume;
        return beyond;
    }
    const auto place = events.begin() + static_cast<std::ptrdiff_t>(event);
    if (gains) {
        *place = {EventKind::touch, !rig.is_rigid(), place->time, 0};
        if (!rig.is_rigid()) events.insert(place + 1, {EventKind::release, false, place->time, 0});
    } else {
        events.erase(place);
    }
    return beyond;
}

std::optional<std::size_t> reversed_pair(const Rig& rig, const OrbitPoint& point) {
    const Orbit& orbit = point.orbit;
    const double duration = rig.at(point.place).duration_of(orbit.period);
    const auto born = [](EventKind a, EventKind b) {
        return (a == EventKind::release && b == EventKind::resume) ||
               (a == EventKind::resume && b == EventKind::release);
    };
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        if (born(orbit.events[i].kind, orbit.after(i).kind) && !(orbit.length_of_leg(i, duration) > 0))
            return i;
    }
    return std::nullopt;
}

OrbitPoint without_pair(const OrbitPoint& point, std::size_t first) {
    OrbitPoint result = point;
    std::vector<Event>& events = result.orbit.events;
    const std::size_t second = (first + 1) % events.size();
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(std::max(first, second)));
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(std::min(first, second)));
    return result;
}

OrbitPoint with_pair_turned(const Rig& rig, const OrbitPoint& point, std::size_t first) {
    OrbitPoint result = point;
    std::vector<Event>& events = result.orbit.events;
    const std::size_t second = (first + 1) % events.size();
    const double turn = second > first ? 0 : rig.at(point.place).duration_of(point.orbit.period);
    std::swap(events[first].velocity, events[second].velocity);
    std::swap(events[first].time, events[second].time);
    events[first].time += turn;
    events[second].time -= turn;
    return result;
}

std::optional<OrbitPoint> with_true_events(const Rig& rig, const OrbitPoint& point) {
    const Stroboscopic start = stroboscopic_states(rig, point).front();
    auto orbit = orbit_from(rig, point.place, start.state, point.orbit.period);
    if (!orbit) return std::nullopt;
    for (Event& event : orbit->events) event.time += start.time;
    const std::size_t grazing = point.orbit.grazing();
    if (grazing < point.orbit.events.size() &&
        !put_grazing_back(point.orbit.events[grazing], rig.at(point.place).duration_of(point.orbit.period),
                          point.orbit.largest_speed(), orbit->events)) {
        return std::nullopt;
    }
    // the same events may begin with a different one
    const std::size_t count = orbit->events.size();
    if (count == point.orbit.events.size()) {
        Orbit turned = *orbit;
        for (std::size_t turn = 0; turn < count; ++turn) {
            if (is_same_motion(turned, point.orbit)) return point;
            std::rotate(turned.events.begin(), turned.events.begin() + 1, turned.events.end());
        }
    }
    return OrbitPoint{*orbit, point.place};
}

namespace {

// A repeated orbit that grazes in one repetition grazes in all of them.
OrbitPoint grazing_with_smallest_period(const Rig& rig, const OrbitPoint& point, double nearness) {
    OrbitPoint rest = point;
    const std::size_t place = point.orbit.grazing();
    Event grazing = point.orbit.events[place];
    if (grazing.presses) return point;
    rest.orbit.events.erase(rest.orbit.events.begin() + static_cast<std::ptrdiff_t>(place));
    if (rest.orbit.events.empty()) return {{1, {grazing}}, point.place};
    rest = with_smallest_period(rig, rest, nearness);
    if (rest.orbit.period == point.orbit.period) return point;
    std::vector<Event>& events = rest.orbit.events;
    const double duration = rig.at(point.place).duration_of(rest.orbit.period);
    grazing.time -= duration * std::floor((grazing.time - events.front().time) / duration);
    events.insert(std::ranges::find_if(events, [&](const Event& event) { return event.time > grazing.time; }),
                  grazing);
    return rest;
}

}  // namespace

OrbitPoint with_smallest_period(const Rig& rig, const OrbitPoint& point, double nearness) {
    if (point.orbit.grazing() < point.orbit.events.size())
        return grazing_with_smallest_period(rig, point, nearness);
    const std::vector<Event>& events = point.orbit.events;
    const double duration = rig.at(point.place).duration_of(point.orbit.period);
    const double speed = point.orbit.largest_speed();
    for (std::int64_t divisor = 1; divisor < point.orbit.period; ++divisor) {
        const auto parts = static_cast<std::size_t>(point.orbit.period / divisor);
        if (point.orbit.period % divisor != 0 || events.size() % parts != 0) continue;
        const std::size_t length = events.size() / parts;
        const double later = duration / static_cast<double>(parts);
        bool repeats = true;
        for (std::size_t i = 0; i + length < events.size() && repeats; ++i) {
            const Event& now = events[i];
            const Event& then = events[i + length];
            repeats = now.kind == then.kind && std::abs(then.time - now.time - later) < nearness * later &&
                      std::abs(then.velocity - now.velocity) < nearness * speed;
        }
        if (!repeats) continue;
        return {{divisor, {events.begin(), events.begin() + static_cast<std::ptrdiff_t>(length)}}, point.place};
    }
    return point;
}

}  // namespace peterka::curves
