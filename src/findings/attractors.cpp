#include "findings/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "regime/same_attractor.hpp"

namespace peterka::findings {

namespace {

using regime::Regime;

auto canonical_key(const Attractor& attractor) {
    const quantities::StoredCell& cell = attractor.cell;
    const double force = std::isnan(cell.peak_force) ? 0 : cell.peak_force;  // a rigid stop has none
    return std::tuple(cell.regime, cell.period, cell.impacts, force, cell.orbit_displacement,
                      cell.orbit_velocity);
}

}  // namespace

bool has_attractor(const quantities::StoredCell& cell) {
    switch (cell.regime) {
        case Regime::no_impact:
        case Regime::chaotic:
        case Regime::sustained_contact:
            return true;
        case Regime::periodic:
            return std::isfinite(cell.orbit_displacement) && std::isfinite(cell.orbit_velocity);
        case Regime::unresolved:
        case Regime::failed:
            break;
    }
    return false;
}

std::int32_t row_of(std::span<const Attractor> table, const quantities::StoredCell& cell) {
    if (!has_attractor(cell)) return no_attractor;
    const auto row = std::ranges::find_if(
        table, [&](const Attractor& known) { return regime::same_attractor(known.cell, cell); });
    return row == table.end() ? no_attractor : static_cast<std::int32_t>(row - table.begin());
}

void sort_canonically(std::vector<Attractor>& table) {
    // Only periodic rows share a regime, and none of their numbers is NaN (has_attractor), so `<` orders them.
    std::ranges::sort(table, {}, canonical_key);
}

}  // namespace peterka::findings
