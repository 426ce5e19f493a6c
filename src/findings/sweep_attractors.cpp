#include "findings/sweep_attractors.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>

#include "findings/start_findings.hpp"

namespace peterka {
namespace {

using quantities::StoredAttractor;
using quantities::StoredCell;
using regime::Regime;

MotionClass class_of(const StoredAttractor& attractor) {
    StoredCell cell;
    cell.regime = attractor.regime;
    cell.impacts = attractor.impacts;
    cell.period = attractor.period;
    return motion_class(cell);
}

}  // namespace

GapAttractors find_beside_branches(std::span<const StoredCell> cells,
                                   std::span<const StoredAttractor> attractors, std::int64_t columns) {
    GapAttractors found{.points = columns};
    const std::int64_t rows = std::ssize(cells) / columns;
    const std::int64_t slots = cells.empty() ? 0 : std::ssize(attractors) / std::ssize(cells);
    std::map<MotionClass, Unvisited> beside;
    for (std::int64_t column = 0; column < columns; ++column) {
        std::int64_t count =
            cells[static_cast<std::size_t>(column)].attractors;  // found by starts, also those not kept
        bool any = false;
        for (std::int64_t slot = 0; slot < slots; ++slot) {
            const auto& attractor = attractors[static_cast<std::size_t>(slot * std::ssize(cells) + column)];
            const auto is_on = [&](std::int64_t row) {
                return cells[static_cast<std::size_t>(row * columns + column)].start_attractor == slot;
            };
            const bool is_found = attractor.share > 0;
            const bool is_known = findings::is_resolved(attractor);
            count += (is_known ? 1 : 0) - (is_found ? 1 : 0);
            bool visited = !is_known;
            for (std::int64_t row = 0; row < rows; ++row) visited = visited || is_on(row);
            if (visited) continue;
            any = true;
            const MotionClass motion = class_of(attractor);
            Unvisited& entry = beside.try_emplace(motion, Unvisited{motion, 0, column, column}).first->second;
            entry.points += entry.points == 0 || entry.last < column ? 1 : 0;
            entry.last = column;
            entry.largest_share = std::max(entry.largest_share, attractor.share);
            for (std::int64_t row = 0; row < rows; ++row) {
                const StoredCell& branch = cells[static_cast<std::size_t>(row * columns + column)];
                entry.beside_its_like = entry.beside_its_like || motion_class(branch) == motion;
            }
        }
        found.several += count > 1 ? 1 : 0;
        found.most = std::max(found.most, count);
        found.with_unvisited += any ? 1 : 0;
    }
    for (const auto& [motion, entry] : beside) found.unvisited.push_back(entry);
    std::ranges::stable_sort(found.unvisited, std::ranges::greater{}, &Unvisited::points);
    return found;
}

}  // namespace peterka
