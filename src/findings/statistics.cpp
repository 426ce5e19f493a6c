#include "findings/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "support/expect.hpp"
#include "support/readable.hpp"

namespace peterka::findings {

namespace {

using regime::Regime;

template <std::size_t size>
void add_each(std::array<std::int64_t, size>& sums, const std::array<std::int64_t, size>& others) {
    std::ranges::transform(sums, others, sums.begin(), std::plus<>());
}

template <std::size_t size>
void count(std::array<std::int64_t, size>& counts, std::int8_t value) {
    const auto index = static_cast<std::uint8_t>(value);  // a fill value lands beyond every class
    if (index < size) ++counts[index];
}

void add_cell(Statistics& statistics, const quantities::StoredCell& cell, std::int64_t row, std::int64_t column,
              double mass) {
    PETERKA_EXPECT(cell.regime != cell::Regime{cell::regime_not_computed} && row >= 0 && column >= 0);
    Counts& counts = statistics.counts;
    ++counts.cells;
    counts.filled += cell.computed ? 0 : 1;
    counts.cycles += cell.cycles;
    count(counts.by_regime, static_cast<std::int8_t>(cell.regime));
    count(counts.by_engine, static_cast<std::int8_t>(cell.engine));
    statistics.proofs.add(cell, std::isnan(cell.impact_speed_upper) ? cell.peak_force : cell.impact_speed);
    if (cell.regime == Regime::unresolved)
        count(counts.unresolved_by_status, static_cast<std::int8_t>(cell.status));
    if (cell.status == regime::Status::chaotic_so_far && cell.computed)
        statistics.longest.take({cell.impact_rate, row, column});
    if (cell.regime == Regime::failed) count(counts.failed_by_status, static_cast<std::int8_t>(cell.status));
    if (regime::has_period(cell.regime)) count(counts.open_by_status, static_cast<std::int8_t>(cell.status));
    if (cell.regime == Regime::chaotic && cell.computed) {
        statistics.chaos.take({cell.observed_cycles, cell.observed_cycles});
    }

    statistics.transients.add(cell);
    const LargestForce force{cell.peak_force, row, column, mass, static_cast<std::int64_t>(cell.regime)};
    statistics.largest.any_regime.take(force);
    if (cell.regime != Regime::periodic) return;
    if (cell.impacts == 1 && cell.period == 1) statistics.largest.one_to_one.take(force);
    ++statistics.periodic_cells[{cell.period, cell.impacts}];
}

std::string reasons(const std::array<std::int64_t, cell::status_names.size()>& counts, const char* what) {
    std::string lines;
    for (std::size_t status = 0; status < counts.size(); ++status) {
        if (counts[status] == 0) continue;
        lines += fmt::format("{} {} {}: {}\n", readable_count(counts[status]),
                             counts[status] == 1 ? "cell" : "cells", what, cell::status_names[status]);
    }
    return lines;
}

}  // namespace

void LargestForce::take(const LargestForce& other) {
    // NaN is never taken; the lower cell wins a tie, so that the order of merging does not matter.
    if (!other.found() || !(other.force() >= force())) return;
    const bool is_lower = std::tie(other.row, other.column) < std::tie(row, column);
    if (other.force() > force() || !found() || is_lower) *this = other;
}

void Extremes::take(const Extremes& other) {
    any_regime.take(other.any_regime);
    one_to_one.take(other.one_to_one);
}

void Observed::take(const Observed& other) {
    fewest = std::min(fewest, other.fewest);
    most = std::max(most, other.most);
}

void LongestChaos::take(const LongestChaos& other) {
    if (!other.found() || !(other.impact_rate <= impact_rate)) return;
    const bool is_lower = std::tie(other.row, other.column) < std::tie(row, column);
    if (other.impact_rate < impact_rate || !found() || is_lower) *this = other;
}

void Counts::add(const Counts& other) {
    add_each(by_regime, other.by_regime);
    add_each(unresolved_by_status, other.unresolved_by_status);
    add_each(failed_by_status, other.failed_by_status);
    add_each(open_by_status, other.open_by_status);
    add_each(by_engine, other.by_engine);
    cells += other.cells;
    filled += other.filled;
    cycles += other.cycles;
}

void add_tile(Statistics& statistics, const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
              std::span<const double> masses) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (static_cast<std::int8_t>(cells[i].regime) == regime::regime_not_computed) continue;
        const auto position = static_cast<std::int64_t>(i);
        add_cell(statistics, cells[i], tile.row + position / tile.extent.columns,
                 tile.column + position % tile.extent.columns, masses.empty() ? 1.0 : masses[i]);
    }
}

std::string failure_text(const Counts& counts) {
    return reasons(counts.failed_by_status, "failed") + reasons(counts.unresolved_by_status, "unresolved");
}

}  // namespace peterka::findings
