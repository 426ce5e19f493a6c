#include "curves/coarse_map.hpp"

#include <algorithm>

#include "attractors/multi_start_pool.hpp"
#include "job/axis.hpp"
#include "regime/same_orbit.hpp"

namespace peterka::curves {

namespace {

Site site_of(const regime::CellResult& cell, double gap) {
    return {cell.regime, cell.status,     cell.impacts,
            cell.period, cell.peak_force, State<double>(cell.orbit_displacement - gap, cell.orbit_velocity)};
}

// Each motion once, represented by the first start that ends on it.
void add_others(const std::vector<regime::CellResult>& ends, double gap, std::vector<Site>& sites) {
    for (const regime::CellResult& end : ends) {
        const Site site = site_of(end, gap);
        const bool is_known = std::ranges::any_of(sites, [&](const Site& known) {
            return same_label(known, site) && regime::coincide(known.orbit[0], site.orbit[0]) &&
                   regime::coincide(known.orbit[1], site.orbit[1]);
        });
        if (site.regime == regime::Regime::periodic && !is_known) sites.push_back(site);
    }
}

void pack_sites(const std::vector<Site>& sites, Numbers& to) {
    to.push_back(static_cast<double>(sites.size()));
    for (const Site& site : sites) {
        to.insert(to.end(), {static_cast<double>(site.regime), static_cast<double>(site.status),
                             static_cast<double>(site.impacts), static_cast<double>(site.period),
                             site.peak_force, site.orbit[0], site.orbit[1]});
    }
}

std::vector<Site> unpack_sites(NumberReader& from) {
    std::vector<Site> sites(static_cast<std::size_t>(from.integer()));
    for (Site& site : sites) {
        site.regime = static_cast<regime::Regime>(from.integer());
        site.status = static_cast<regime::Status>(from.integer());
        site.impacts = from.integer();
        site.period = from.integer();
        site.peak_force = from.number();
        site.orbit[0] = from.number();
        site.orbit[1] = from.number();
    }
    return sites;
}

// The finalizer of SplitMix64 (Steele, Lea & Flood 2014).
std::uint64_t scattered(std::uint64_t n) {
    n = (n ^ (n >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    n = (n ^ (n >> 27U)) * 0x94d049bb133111ebULL;
    return n ^ (n >> 31U);
}

}  // namespace

std::int64_t CoarseMap::parts() const {
    return (count() + cells_in_part - 1) / cells_in_part;
}

PlanePoint CoarseMap::place(std::int64_t cell) const {
    const job::Job& job = scene_->job();
    return rig_->place_of(
        {job::axis_value(job.columns, cell % columns()), job::axis_value(job.rows, cell / columns())});
}

Numbers CoarseMap::solve(std::int64_t part) const {
    const std::int64_t first = part * cells_in_part;
    const std::int64_t end = std::min(first + cells_in_part, count());
    std::vector<std::vector<Site>> sites(static_cast<std::size_t>(end - first));
    const regime::AttractorTable nothing_known;
    const auto keep = [&](const attractors::MultiStartPool::NumberedCell& solved) {
        const double gap = rig_->at(place(solved.number)).gap();
        std::vector<Site>& of_cell = sites[static_cast<std::size_t>(solved.number - first)];
        of_cell = {site_of(solved.cell.cell, gap)};
        add_others(solved.cell.ends, gap, of_cell);
    };
    attractors::MultiStartPool pool(*scene_, nothing_known, keep, attractors::Ends::told);
    for (std::int64_t next = first; next < end || !pool.empty(); pool.step()) {
        for (; next < end && pool.has_room(); ++next) pool.add(next / columns(), next % columns(), next);
    }
    Numbers numbers;
    for (const std::vector<Site>& of_cell : sites) pack_sites(of_cell, numbers);
    return numbers;
}

void CoarseMap::put_together(const std::vector<Numbers>& parts) {
    sites_.clear();
    for (const Numbers& part : parts) {
        for (NumberReader reader(part); !reader.done();) sites_.push_back(unpack_sites(reader));
    }
}

std::optional<OrbitPoint> CoarseMap::orbit(std::int64_t cell, const PlanePoint& window,
                                           std::size_t site_of_cell) const {
    const Site& at = sites(cell)[site_of_cell];
    if (at.regime != regime::Regime::periodic) return std::nullopt;
    return stable_orbit_near(*rig_, place(cell), at.orbit, at.period, window);
}

std::vector<Edge> edges_of(const CoarseMap& map, std::int64_t most_period) {
    std::vector<Edge> edges;
    const auto add_further = [&](std::int64_t a, std::int64_t b) {
        for (std::size_t i = 1; i < map.sites(a).size(); ++i) {
            const Site& site = map.sites(a)[i];
            const bool goes_on =
                std::ranges::any_of(map.sites(b), [&](const Site& other) { return same_label(site, other); });
            if (site.is_periodic(most_period) && !goes_on) edges.push_back({a, b, i});
        }
    };
    const auto add = [&](std::int64_t a, std::int64_t b) {
        add_further(a, b);
        add_further(b, a);
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
                         static_cast<std::uint64_t>(edge.to) + edge.site * 0xd1b54a32d192ed03ULL);
    };
    std::ranges::sort(edges, {}, key);
    return edges;
}

}  // namespace peterka::curves
