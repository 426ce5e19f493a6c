#include "regime/attractor_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regime/same_orbit.hpp"
#include "regime/scalar_engine.hpp"

namespace peterka::regime {

namespace {

constexpr std::size_t most_attractors = 64;  // distinguished; few scenes have ten
constexpr std::int64_t most_places = 8;      // per orbit
constexpr double saved_cycles = 2;           // lower bound, by a start that ends in a neighbourhood

struct Candidate {
    FoundAttractor found;
    std::int64_t times = 0;  // how often it was found
};

bool has_orbit(const CellResult& result) {
    const bool settled = result.regime == Regime::periodic || result.regime == Regime::sustained_contact;
    return settled && result.period > 0 && std::isfinite(result.orbit_displacement) &&
           std::isfinite(result.orbit_velocity);
}

scene::Oscillator<double> with_cubic(scene::Oscillator<double> oscillator, double cubic) {
    oscillator.cubic = cubic;
    return oscillator;
}

// The distinct attractors, in the order in which they were first found.
std::vector<Candidate> distinct(const scene::Oscillator<double>& rig, std::span<const FoundAttractor> all) {
    std::vector<Candidate> candidates;
    for (const FoundAttractor& found : all) {
        if (!has_orbit(found.result)) continue;
        const scene::Oscillator<double> oscillator = with_cubic(rig, found.cubic);
        const auto known = std::ranges::find_if(candidates, [&](const Candidate& candidate) {
            return candidate.found.cubic == found.cubic &&
                   same_map(oscillator, candidate.found.settings, found.settings) &&
                   same_orbit(candidate.found.result, found.result);
        });
        if (known != candidates.end()) {
            ++known->times;
        } else if (candidates.size() < most_attractors) {
            candidates.push_back({found, 1});
        }
    }
    return candidates;
}

}  // namespace

bool same_map(const scene::Oscillator<double>& oscillator, const EngineSettings& a, const EngineSettings& b) {
    if (a.engine != b.engine) return false;
    if (a.engine == Engine::exact) return true;
    if (a.engine != Engine::split) return a.tolerance == b.tolerance;
    const auto steps = [&](const EngineSettings& settings) {
        return trajectory::split_steps(oscillator, settings.largest_displacement, settings.tolerance);
    };
    return steps(a) == steps(b);
}

AttractorTable::AttractorTable(const scene::Oscillator<double>& rig, std::span<const FoundAttractor> found,
                               double cells_each) {
    for (const Candidate& candidate : distinct(rig, found)) {
        const CellResult& result = candidate.found.result;
        const double saved = saved_cycles * cells_each * static_cast<double>(candidate.times);
        const auto affordable =
            static_cast<std::int64_t>(saved / static_cast<double>(cycles_for_neighbourhood(result.period)));
        const std::int64_t count = std::min({affordable, most_places, std::int64_t{result.period}});
        const scene::Oscillator<double> oscillator = with_cubic(rig, candidate.found.cubic);
        CycleBroker broker;
        add(oscillator, candidate.found,
            complete(find_places(broker, oscillator, candidate.found, count), broker).neighbourhoods);
    }
}

void AttractorTable::add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found,
                         std::span<const Neighbourhood> places) {
    if (places.empty()) return;
    AttractorsOfMap& map = map_of(oscillator, found.settings);
    for (const Neighbourhood& place : places) map.places_.push_back({place, found.result});
}

void AttractorTable::add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found,
                         KnownOrbit orbit) {
    map_of(oscillator, found.settings).orbits_.push_back({std::move(orbit), found.result, found.by_cubic});
}

AttractorTable::AttractorsOfMap& AttractorTable::map_of(const scene::Oscillator<double>& oscillator,
                                                        const EngineSettings& settings) {
    auto map = std::ranges::find_if(maps_, [&](const auto& any) { return any.is_of(oscillator, settings); });
    if (map == maps_.end()) map = maps_.insert(map, AttractorsOfMap(oscillator.cubic, settings));
    return *map;
}

Task<Places> find_places(CycleBroker& broker, scene::Oscillator<double> oscillator, FoundAttractor found,
                         std::int64_t count) {
    StroboscopicMap map(oscillator, found.settings, broker);
    const Point point = map.scaled(
        scene::State<double>(found.result.orbit_displacement - oscillator.gap, found.result.orbit_velocity));
    Places places;
    places.neighbourhoods = co_await find_neighbourhoods(map, point, found.result.period, count);
    places.cycles = map.cycles_spent();
    co_return places;
}

Task<std::optional<KnownOrbit>> find_known_orbit(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                                 FoundAttractor found, std::int64_t* spent) {
    StroboscopicMap map(oscillator, found.settings, broker);
    const Point point = map.scaled(
        scene::State<double>(found.result.orbit_displacement - oscillator.gap, found.result.orbit_velocity));
    auto orbit = co_await follow_known_orbit(map, point, found.result.period);
    *spent = map.cycles_spent();
    co_return orbit;
}

bool AttractorTable::AttractorsOfMap::is_of(const scene::Oscillator<double>& oscillator,
                                            const EngineSettings& settings) const {
    return cubic_ == oscillator.cubic && same_map(oscillator, settings_, settings);
}

std::optional<CubicShift> AttractorTable::AttractorsOfMap::shift_of(const CellResult& taken) const {
    const auto known = std::ranges::find_if(orbits_, [&](const Orbit& each) {
        return each.attractor.period == taken.period &&
               each.attractor.orbit_displacement == taken.orbit_displacement &&
               each.attractor.orbit_velocity == taken.orbit_velocity;
    });
    return known == orbits_.end() ? std::nullopt : known->by_cubic;
}

std::optional<AttractorTable::AttractorsOfMap::Near> AttractorTable::AttractorsOfMap::orbit_near(
    const Point& state, std::int64_t q) const {
    for (const Orbit& each : orbits_) {
        if (q % each.orbit.period() != 0) continue;
        if (auto orbit = each.orbit.seen_from(state)) return Near{std::move(*orbit), &each.attractor};
    }
    return std::nullopt;
}

const AttractorTable::AttractorsOfMap* AttractorTable::of(const scene::Oscillator<double>& oscillator,
                                                          const EngineSettings& settings) const {
    const auto map =
        std::ranges::find_if(maps_, [&](const auto& any) { return any.is_of(oscillator, settings); });
    return map == maps_.end() ? nullptr : &*map;
}

}  // namespace peterka::regime
