#include "findings/sweep_findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>

namespace peterka {
namespace {

using quantities::StoredCell;
using regime::Regime;

template <class Takes>
std::optional<std::int64_t> column_of_largest_force(std::span<const StoredCell> cells, const Takes& takes) {
    std::optional<std::int64_t> largest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!takes(cells[i]) || !(cells[i].peak_force > 0)) continue;
        if (!largest || cells[i].peak_force > cells[static_cast<std::size_t>(*largest)].peak_force) {
            largest = static_cast<std::int64_t>(i);
        }
    }
    return largest;
}

std::vector<Band> bands_of(std::span<const StoredCell> cells) {
    std::vector<Band> bands;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto column = static_cast<std::int64_t>(i);
        const MotionClass motion = motion_class(cells[i]);
        if (bands.empty() || bands.back().motion != motion) bands.push_back({motion, column, column});
        bands.back().last = column;
    }
    return bands;
}

std::vector<Jump> jumps_of(std::span<const StoredCell> cells, job::Direction direction) {
    const bool down = direction == job::Direction::down;
    std::vector<Jump> jumps;
    for (std::int64_t i = 0; i < std::ssize(cells); ++i) {
        if (cells[static_cast<std::size_t>(i)].jump) jumps.push_back({down ? i + 1 : i - 1, i});
    }
    if (down) std::ranges::reverse(jumps);
    return jumps;
}

std::vector<std::pair<MotionClass, std::int64_t>> points_by_class(std::span<const Band> bands) {
    std::map<MotionClass, std::int64_t> counts;
    for (const Band& band : bands) counts[band.motion] += band.points();
    std::vector<std::pair<MotionClass, std::int64_t>> points(counts.begin(), counts.end());
    std::ranges::stable_sort(points, std::ranges::greater{}, &std::pair<MotionClass, std::int64_t>::second);
    return points;
}

Side side(const BranchFindings& found, std::int64_t column, std::int64_t other) {
    if (other < 0 || other >= std::ssize(found.cells)) return Side::end_of_sweep;
    const auto cell = [&](std::int64_t i) -> const StoredCell& {
        return found.cells[static_cast<std::size_t>(i)];
    };
    const bool down = found.branch.direction == job::Direction::down;
    const std::int64_t later = down ? std::min(column, other) : std::max(column, other);
    if (cell(later).jump) return Side::jump;
    return motion_class(cell(column)) == motion_class(cell(other)) ? Side::own_band : Side::other_band;
}

enum class Compared { alike, different, unknown };

Compared compare(const StoredCell& a, const StoredCell& b) {
    const auto is_open = [](const StoredCell& cell) {
        return cell.regime == Regime::unresolved || cell.regime == Regime::failed;
    };
    if (is_open(a) || is_open(b)) return Compared::unknown;
    const bool has_blow = regime::has_period(a.regime) && regime::has_period(b.regime);  // chaos has many
    const bool differ = motion_class(a) != motion_class(b) ||
                        (has_blow && std::abs(blow(a) - blow(b)) > 0.01 * std::max(blow(a), blow(b)));
    return differ ? Compared::different : Compared::alike;
}

}  // namespace

MotionClass motion_class(const StoredCell& cell) {
    return {cell.regime, cell.regime == Regime::periodic ? findings::ImpactClass{cell.period, cell.impacts}
                                                         : findings::ImpactClass{}};
}

BranchFindings find_in_branch(const job::Branch& branch, std::vector<StoredCell> cells) {
    BranchFindings found{.branch = branch, .cells = std::move(cells)};
    constexpr findings::ImpactClass one_a_cycle{.period = 1, .impacts = 1};
    found.one_to_one = column_of_largest_force(
        found.cells, [&](const StoredCell& cell) { return motion_class(cell).z == one_a_cycle; });
    found.largest = column_of_largest_force(found.cells, [](const StoredCell&) { return true; });
    if (const auto at = found.one_to_one) {
        found.around_one_to_one = {side(found, *at, *at - 1), side(found, *at, *at + 1)};
    }
    found.jumps = jumps_of(found.cells, branch.direction);
    found.bands = bands_of(found.cells);
    found.points = points_by_class(found.bands);
    return found;
}

std::vector<Stretch> find_hysteresis(const BranchFindings& up, const BranchFindings& down) {
    std::vector<Stretch> found;
    std::optional<Stretch> open;
    const auto close = [&] {
        if (open) found.push_back(*open);
        open.reset();
    };
    for (std::int64_t i = 0; i < std::ssize(up.cells); ++i) {
        const auto column = static_cast<std::size_t>(i);
        const Compared compared = compare(up.cells[column], down.cells[column]);
        if (compared == Compared::alike) close();
        if (compared != Compared::different) continue;
        if (!open) open = Stretch{i, i};
        open->last = i;
    }
    close();
    return found;
}

}  // namespace peterka
