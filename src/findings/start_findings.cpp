#include "findings/start_findings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace peterka::findings {

namespace {

using quantities::StoredAttractor;
using regime::Regime;

bool impacts_for_ever(const StoredAttractor& attractor) {
    return attractor.regime == Regime::periodic || attractor.regime == Regime::chaotic;
}

// Unresolved ones may do either.
bool ends_free_or_pressed(const StoredAttractor& attractor) {
    return attractor.regime == Regime::no_impact || attractor.regime == Regime::sustained_contact;
}

bool is_in_use(const StoredAttractor& attractor) {
    return attractor.regime != static_cast<Regime>(regime::regime_not_computed);
}

AttractorLabel label_of(const StoredAttractor& attractor) {
    return {attractor.regime, attractor.period, attractor.impacts};
}

// all: the slots in use, the largest share first, those known without a share last.
void add_cell(StartFindings& findings, const quantities::StoredCell& cell, std::span<const StoredAttractor> all,
              const parallel::CellIndex& place) {
    StartCounts& counts = findings.counts;
    ++counts.cells;
    const auto hits = std::ranges::count_if(all, impacts_for_ever);
    const auto without = std::ranges::count_if(all, ends_free_or_pressed);
    counts.mixed += hits > 0 && without > 0 ? 1 : 0;
    counts.never_hit += without == std::ssize(all) ? 1 : 0;
    const auto found = std::ranges::count_if(all, [](const auto& slot) { return slot.share > 0; });
    const auto here = all.first(static_cast<std::size_t>(found));
    const auto known = all.subspan(here.size());
    const auto unresolved = std::ssize(here) - std::ranges::count_if(here, is_resolved);
    ++counts
          .by_number[std::min(static_cast<std::size_t>(cell.attractors - unresolved), StartCounts::told_apart)];
    const auto known_hits = std::ranges::count_if(known, impacts_for_ever);
    counts.known_hit += known_hits > 0 ? 1 : 0;
    counts.known_free += std::ranges::any_of(known, ends_free_or_pressed) ? 1 : 0;
    const bool ends = cell.regime != Regime::unresolved && cell.regime != Regime::failed;
    counts.minority += ends && cell.start_attractor != 0 ? 1 : 0;
    counts.not_kept += ends && cell.start_attractor < 0 ? 1 : 0;
    counts.left_over += cell.attractors > std::ssize(here) ? 1 : 0;
    for (const StoredAttractor& each : here) {
        if (each.regime != Regime::failed) continue;
        ++counts.failing;
        counts.most_failing = std::max(counts.most_failing, each.share);
    }
    for (const StoredAttractor& each : all) {
        if (std::isnan(each.mean_life) || cell::has_period(each.regime)) continue;
        ++counts.dying;
        counts.shortest.take({each.mean_life, each.mean_life_error, place.row, place.column});
    }
    // a rigid stop's attractors have no computed peak to compare
    for (const StoredAttractor& each : all) {
        counts.proofs.add(each, each.peak_force);
        if (cell.computed) counts.lives.add(each, place.row, place.column);
    }
    add_kick(counts.kicks, all, place);
    const auto first = std::ranges::find_if(here, is_resolved);
    if (first == here.end()) return;
    const auto second = std::ranges::find_if(first + 1, here.end(), is_resolved);
    if (second == here.end()) return;
    const AttractorLabel one = label_of(*first);
    const AttractorLabel other = label_of(*second);
    ++findings.pairs[{std::min(one, other), std::max(one, other)}];
}

}  // namespace

bool is_resolved(const StoredAttractor& attractor) {
    return is_in_use(attractor) && attractor.regime != Regime::unresolved && attractor.regime != Regime::failed;
}

void StartCounts::add(const StartCounts& other) {
    std::ranges::transform(by_number, other.by_number, by_number.begin(), std::plus<>());
    cells += other.cells;
    mixed += other.mixed;
    never_hit += other.never_hit;
    known_free += other.known_free;
    known_hit += other.known_hit;
    minority += other.minority;
    not_kept += other.not_kept;
    left_over += other.left_over;
    failing += other.failing;
    most_failing = std::max(most_failing, other.most_failing);
    dying += other.dying;
    shortest.take(other.shortest);
    kicks.add(other.kicks);
    proofs.add(other.proofs);
    lives.add(other.lives);
}

void add_attractors(StartFindings& findings, const parallel::Tile& tile,
                    std::span<const quantities::StoredCell> cells,
                    std::span<const StoredAttractor> attractors) {
    const std::size_t slots = cells.empty() ? 0 : attractors.size() / cells.size();
    std::vector<StoredAttractor> here;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (cells[cell].attractors < 0) continue;
        const auto position = static_cast<std::int64_t>(cell);
        const parallel::CellIndex place{tile.row + position / tile.extent.columns,
                                        tile.column + position % tile.extent.columns};
        if (slots == 0) {
            add_kick(findings.counts.kicks, cells[cell], place);
            if (cells[cell].computed) findings.counts.lives.add(cells[cell], place.row, place.column);
        }
        here.clear();
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const StoredAttractor& attractor = attractors[slot * cells.size() + cell];
            if (is_in_use(attractor)) here.push_back(attractor);
        }
        add_cell(findings, cells[cell], here, place);
    }
}

}  // namespace peterka::findings
