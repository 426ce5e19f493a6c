#include "refine/fill.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "job/stored_quantities.hpp"
#include "refine/fill_attractors.hpp"

namespace peterka::refine {
namespace {

using regime::CellResult;
using regime::Regime;

bool alike(const CellResult& a, const CellResult& b) {
    return regime::same_label(a, b) && a.chatter == b.chatter;
}

template <class Condition>
std::size_t count_if(const Surroundings& around, Condition condition) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < around.rows().size; ++i) {
        for (std::size_t j = 0; j < around.columns().size; ++j) count += condition(around.at(i, j)) ? 1 : 0;
    }
    return count;
}

std::size_t size_of(const Surroundings& around) {
    return around.rows().size * around.columns().size;
}

// On the finest lattice; chosen so that 99.9 % of 4097 x 4097 cells of the paper's plane have the right label.
constexpr double others_in_chaos = 0.3;

bool lies_inside_chaos(const Surroundings& around) {
    const auto is_chaotic = [](const CellResult& cell) { return cell.regime == Regime::chaotic; };
    for (const std::size_t i : {around.rows().before, around.rows().after}) {
        for (const std::size_t j : {around.columns().before, around.columns().after}) {
            if (!is_chaotic(around.at(i, j))) return false;
        }
    }
    const auto others = static_cast<double>(size_of(around) - count_if(around, is_chaotic));
    return others * static_cast<double>(around.stride()) <=
           others_in_chaos * static_cast<double>(size_of(around));
}

// Deviation of the middle one of three values from the line through the others.
double bend(const Stencil& line, std::size_t first, double a, double b, double c) {
    const auto length = static_cast<double>(line.positions[first + 2] - line.positions[first]);
    const double share = static_cast<double>(line.positions[first + 1] - line.positions[first]) / length;
    return std::abs(b - (a + share * (c - a)));
}

std::optional<CellResult> filled_cell(const Surroundings& around,
                                      std::span<const cell::Quantity* const> interpolated_ones) {
    const CellResult& next = around.at(around.rows().before, around.columns().before);
    if (lies_inside_chaos(around)) {
        CellResult cell{.regime = Regime::chaotic, .engine = next.engine, .computed = false};
        cell.impact_rate = regime::unknown;
        return cell;
    }
    const auto like_next = [&](const CellResult& cell) { return alike(cell, next); };
    if (!regime::has_period(next.regime) || count_if(around, like_next) < size_of(around)) return std::nullopt;

    CellResult cell{.computed = false};
    for (const cell::Quantity& quantity : cell::quantities) {
        if (quantity.filled == cell::Filled::as_around) quantity.store(cell, quantity.load(next));
    }
    for (const cell::Quantity* quantity : interpolated_ones) {
        const std::optional<double> value = interpolated(
            around, values_around(around, [&](auto i, auto j) { return quantity->load(around.at(i, j)); }));
        if (!value) return std::nullopt;
        quantity->store(cell, *value);
    }
    return cell;
}

}  // namespace

std::optional<double> interpolated(const Surroundings& around, const Values& values, double rough) {
    const auto value = [&](std::size_t i, std::size_t j) { return values[i][j]; };
    const Stencil& rows = around.rows();
    const Stencil& columns = around.columns();
    std::size_t lacking = 0;
    for (std::size_t i = 0; i < rows.size; ++i) {
        for (std::size_t j = 0; j < columns.size; ++j) lacking += std::isnan(value(i, j)) ? 1 : 0;
    }
    if (lacking == size_of(around)) return regime::unknown;
    if (lacking > 0) return std::nullopt;
    double sum = 0;
    double largest = 0;
    double largest_bend = 0;
    for (std::size_t i = 0; i < rows.size; ++i) {
        for (std::size_t j = 0; j < columns.size; ++j) {
            sum += rows.weights[i] * columns.weights[j] * value(i, j);
            largest = std::max(largest, std::abs(value(i, j)));
            if (i + 2 < rows.size)
                largest_bend =
                    std::max(largest_bend, bend(rows, i, value(i, j), value(i + 1, j), value(i + 2, j)));
            if (j + 2 < columns.size)
                largest_bend =
                    std::max(largest_bend, bend(columns, j, value(i, j), value(i, j + 1), value(i, j + 2)));
        }
    }
    if (std::isnan(sum) || largest_bend > std::max(rough, smoothness * largest)) return std::nullopt;
    return sum;
}

std::vector<const cell::Quantity*> interpolated_quantities(const job::Job& job) {
    std::vector<const cell::Quantity*> smooth = job::stored_quantities(job);
    std::erase_if(
        smooth, [](const cell::Quantity* quantity) { return quantity->filled != cell::Filled::interpolated; });
    return smooth;
}

namespace {

bool fill_attractors(attractors::SolvedCell& solved, const Surroundings& around, std::int64_t starts) {
    auto attractors = filled_attractors(around, starts);
    if (!attractors) return false;
    solved.attractors = std::move(*attractors);
    solved.cell.attractors = static_cast<std::int32_t>(solved.attractors.size());
    const auto slot = std::ranges::find_if(solved.attractors, [&](const attractors::CellAttractor& each) {
        return each.regime == solved.cell.regime && each.impacts == solved.cell.impacts &&
               each.period == solved.cell.period;
    });
    if (slot != solved.attractors.end())
        solved.cell.start_attractor = static_cast<std::int32_t>(slot - solved.attractors.begin());
    return true;
}

bool fill_outcomes(attractors::SolvedCell& solved, const Surroundings& around,
                   std::span<const cell::Quantity* const> interpolated_ones, std::int64_t rigs) {
    auto outcomes = filled_outcomes(around, rigs);
    if (!outcomes) return false;
    solved.outcomes = std::move(*outcomes);
    solved.cell.outcomes = static_cast<std::int32_t>(solved.outcomes.size());
    for (const cell::Quantity* quantity : interpolated_ones) {
        if (!cell::is_of_uncertain_rigs(*quantity)) continue;
        const std::optional<double> value = interpolated(
            around, values_around(around, [&](auto i, auto j) { return quantity->load(around.at(i, j)); }));
        if (!value) return false;
        quantity->store(solved.cell, *value);
    }
    return true;
}

}  // namespace

std::optional<attractors::SolvedCell> filled(const Surroundings& around,
                                             std::span<const cell::Quantity* const> interpolated_ones,
                                             const Tries& tries) {
    const std::optional<CellResult> cell = filled_cell(around, interpolated_ones);
    if (!cell) return std::nullopt;
    attractors::SolvedCell solved{*cell, {}};
    if (tries.starts > 0 && !fill_attractors(solved, around, tries.starts)) return std::nullopt;
    if (tries.rigs > 0 && !fill_outcomes(solved, around, interpolated_ones, tries.rigs)) return std::nullopt;
    return solved;
}

}  // namespace peterka::refine
