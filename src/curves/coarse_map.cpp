#include "curves/coarse_map.hpp"

#include <algorithm>

#include "job/axis.hpp"
#include "regime/cell_pool.hpp"

namespace peterka::curves {

namespace {

// The numbers of a site on their way between ranks.
constexpr std::size_t site_numbers = 6;

std::uint64_t scattered(std::uint64_t n) {
    n = (n ^ (n >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    n = (n ^ (n >> 27U)) * 0x94d049bb133111ebULL;
    return n ^ (n >> 31U);
}

}  // namespace

std::int64_t CoarseMap::parts() const {
    return (count() + cells_in_part - 1) / cells_in_part;
}

Place CoarseMap::place(std::int64_t cell) const {
    const scene::Oscillator<double> oscillator = scene_->cell(cell / columns(), cell % columns()).oscillator;
    return {oscillator.frequency, oscillator.gap};
}

Numbers CoarseMap::solve(std::int64_t part) const {
    const std::int64_t first = part * cells_in_part;
    const std::int64_t end = std::min(first + cells_in_part, count());
    Numbers numbers(static_cast<std::size_t>(end - first) * site_numbers);
    const regime::AttractorTable nothing_known;
    regime::CellPool pool(*scene_, nothing_known, [&](const regime::CellPool::Solved& solved) {
        const regime::CellResult& cell = solved.result;
        const Numbers site{static_cast<double>(cell.regime),
                           static_cast<double>(cell.impacts),
                           static_cast<double>(cell.period),
                           cell.orbit_displacement,
                           cell.orbit_velocity,
                           cell.peak_force};
        std::ranges::copy(site, numbers.begin() + (solved.number - first) * std::ptrdiff_t{site_numbers});
    });
    for (std::int64_t next = first; next < end || !pool.empty(); pool.step()) {
        for (; next < end && pool.has_room(); ++next) pool.add(next / columns(), next % columns(), next);
    }
    return numbers;
}

void CoarseMap::put_together(const std::vector<Numbers>& parts) {
    sites_.clear();
    for (const Numbers& part : parts) {
        for (NumberReader reader(part); !reader.done();) {
            Site site;
            site.regime = static_cast<regime::Regime>(reader.integer());
            site.impacts = reader.integer();
            site.period = reader.integer();
            const double displacement = reader.number();
            site.orbit = {displacement - place(std::ssize(sites_)).gap, reader.number()};
            site.peak_force = reader.number();
            sites_.push_back(site);
        }
    }
}

std::optional<OrbitPoint> CoarseMap::orbit(const Rig& rig, std::int64_t cell, const Place& window) const {
    const Site& at = site(cell);
    if (at.regime != regime::Regime::periodic) return std::nullopt;
    return stable_orbit_near(rig, place(cell), at.orbit, at.period, window);
}

std::vector<Edge> edges_of(const CoarseMap& map, std::int64_t most_period) {
    std::vector<Edge> edges;
    const auto add = [&](std::int64_t a, std::int64_t b) {
        if (same_label(map.site(a), map.site(b))) return;
        if (map.site(a).is_periodic(most_period)) edges.push_back({a, b});
        if (map.site(b).is_periodic(most_period)) edges.push_back({b, a});
    };
    for (std::int64_t cell = 0; cell < map.count(); ++cell) {
        if ((cell + 1) % map.columns() != 0) add(cell, cell + 1);
        if (cell + map.columns() < map.count()) add(cell, cell + map.columns());
    }
    const auto key = [](const Edge& edge) {
        return scattered(static_cast<std::uint64_t>(edge.from) * 0x9e3779b97f4a7c15ULL +
                         static_cast<std::uint64_t>(edge.to));
    };
    std::ranges::sort(edges, {}, key);
    return edges;
}

}  // namespace peterka::curves
