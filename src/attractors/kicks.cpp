#include "attractors/kicks.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "regime/same_attractor.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::attractors {

namespace {

using regime::CellResult;
using regime::CycleDesk;

constexpr std::int64_t levels = 24;  // sizes tried: the smallest is 1/576 of the largest
constexpr int most_bisections = 12;  // to 1/4096 of the distance between two sizes

// The points of an orbit at forcing phase 0, from the one that names it.
Task<CellResult> follow_orbit(CycleDesk& desk, scene::Oscillator<double> oscillator,
                              regime::FoundAttractor found, std::vector<scene::State<double>>* points) {
    oscillator.cubic = found.cubic;
    regime::StroboscopicMap map(oscillator, found.settings, desk);
    regime::Point point = map.scaled(
        scene::State<double>(found.result.orbit_displacement - oscillator.gap, found.result.orbit_velocity));
    points->push_back(map.unscaled(point));
    for (std::int32_t n = 1; n < found.result.period; ++n) {
        const regime::Passage cycle = co_await map.cycle(point);
        if (!cycle.ok) break;
        point = cycle.end;
        points->push_back(map.unscaled(point));
    }
    co_return CellResult{.cycles = static_cast<std::int32_t>(map.cycles_spent())};
}

}  // namespace

Kicks::Kicks(const scene::Oscillator<double>& cell, std::span<const Tally::Entry> attractors, double largest,
             SearchFrom search_from)
    : cell_(cell),
      attractors_(attractors.begin(), attractors.end()),
      largest_(largest),
      search_from_(std::move(search_from)) {}

std::vector<Begin> Kicks::next(std::span<const Ended> ended) {
    switch (stage_) {
        case Stage::begin:
            stage_ = Stage::orbits;
            return follow_orbits();
        case Stage::orbits:
            stage_ = Stage::scan;
            return scan();
        case Stage::scan:
            take_scan(ended);
            stage_ = Stage::bisection;
            return bisect();
        case Stage::bisection:
            take_bisection(ended);
            if (++bisections_ < most_bisections) return bisect();
            stage_ = Stage::done;
            break;
        case Stage::done:
            break;
    }
    return {};
}

double Kicks::smallest(std::size_t slot) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Ray& ray : rays_) {
        if (ray.slot == slot && ray.leaves > 0) smallest = std::min(smallest, ray.leaves);
    }
    return smallest < std::numeric_limits<double>::infinity() ? smallest : regime::unknown;
}

std::vector<Begin> Kicks::follow_orbits() {
    for (std::size_t slot = 0; slot < attractors_.size(); ++slot) {
        if (attractors_[slot].orbit) followed_.push_back(slot);
    }
    orbits_.resize(followed_.size());
    std::vector<Begin> searches;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        searches.emplace_back([this, i](CycleDesk& desk, std::vector<regime::FoundAttractor>*) {
            return follow_orbit(desk, cell_, *attractors_[followed_[i]].orbit, &orbits_[i]);
        });
    }
    return searches;
}

std::vector<Begin> Kicks::scan() {
    std::vector<Begin> searches;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        for (const scene::State<double>& point : orbits_[i]) {
            for (const double sign : {1.0, -1.0}) rays_.push_back({followed_[i], point, sign});
        }
    }
    for (const Ray& ray : rays_) {
        for (std::int64_t level = 1; level <= levels; ++level) searches.push_back(kick(ray, size_of(level)));
    }
    return searches;
}

// Keeps, of each attractor, the rays that leave it at the lowest level of all.
void Kicks::take_scan(std::span<const Ended> ended) {
    std::vector<std::int64_t> lowest(attractors_.size(), levels + 1);
    std::vector<std::int64_t> leaves(rays_.size(), levels + 1);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        for (std::int64_t level = levels; level > 0; --level) {
            const auto search = i * static_cast<std::size_t>(levels) + static_cast<std::size_t>(level - 1);
            if (ends_elsewhere(rays_[i], ended[search])) leaves[i] = level;
        }
        lowest[rays_[i].slot] = std::min(lowest[rays_[i].slot], leaves[i]);
    }
    std::vector<Ray> narrowed;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (leaves[i] > levels || leaves[i] > lowest[rays_[i].slot]) continue;
        rays_[i].stays = size_of(leaves[i] - 1);
        rays_[i].leaves = size_of(leaves[i]);
        narrowed.push_back(rays_[i]);
    }
    rays_ = std::move(narrowed);
}

std::vector<Begin> Kicks::bisect() {
    std::vector<Begin> searches;
    for (const Ray& ray : rays_) searches.push_back(kick(ray, ray.middle()));
    return searches;
}

void Kicks::take_bisection(std::span<const Ended> ended) {
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        (ends_elsewhere(rays_[i], ended[i]) ? rays_[i].leaves : rays_[i].stays) = rays_[i].middle();
    }
}

bool Kicks::ends_elsewhere(const Ray& ray, const Ended& ended) const {
    return !regime::same_attractor(attractors_[ray.slot].result, ended.result);
}

Begin Kicks::kick(const Ray& ray, double size) const {
    return search_from_({ray.point[0], ray.point[1] + ray.sign * size});
}

double Kicks::size_of(std::int64_t level) const {
    const double share = static_cast<double>(level) / static_cast<double>(levels);
    return largest_ * share * share;
}

}  // namespace peterka::attractors
