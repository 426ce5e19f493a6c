#include "findings/kick_counts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace peterka::findings {

namespace {

// Compares sizes above 0; any other value is not a size.
bool is_smaller(double one, double other) {
    return one > 0 && (!(other > 0) || one < other);
}

// motion: a stored cell or attractor.
void add_one(KickCounts& counts, const auto& motion, const parallel::CellIndex& place, bool is_alone) {
    const cell::Kick& kick = motion.kick;
    if (std::isnan(kick.tried)) return;
    const bool is_thrown = !std::isnan(kick.size);
    counts.add({.kicked = 1,
                .thrown = is_thrown ? 1 : 0,
                .alone = !is_thrown && is_alone ? 1 : 0,
                .smallest = is_thrown ? kick.size : 0,
                .phase = is_thrown ? kick.phase : 0,
                .row = is_thrown ? place.row : -1,
                .column = is_thrown ? place.column : -1,
                .by_rounding = is_thrown && motion.status == cell::Status::rounding ? 1 : 0,
                .least_tried = is_thrown ? 0 : kick.tried,
                .most_tried = is_thrown ? 0 : kick.tried,
                .bounded = std::isnan(kick.lower) ? 0 : 1,
                .least_bound = std::isnan(kick.lower) ? 0 : kick.lower});
}

}  // namespace

void KickCounts::add(const KickCounts& other) {
    kicked += other.kicked;
    thrown += other.thrown;
    alone += other.alone;
    bounded += other.bounded;
    if (is_smaller(other.least_bound, least_bound)) least_bound = other.least_bound;
    if (is_smaller(other.least_tried, least_tried)) least_tried = other.least_tried;
    most_tried = std::max(most_tried, other.most_tried);
    const bool first = other.smallest == smallest && std::tie(other.row, other.column) < std::tie(row, column);
    if (!first && !is_smaller(other.smallest, smallest)) return;
    smallest = other.smallest;
    phase = other.phase;
    row = other.row;
    column = other.column;
    by_rounding = other.by_rounding;
}

void add_kick(KickCounts& counts, const quantities::StoredCell& cell, const parallel::CellIndex& place) {
    add_one(counts, cell, place, false);
}

void add_kick(KickCounts& counts, std::span<const quantities::StoredAttractor> here,
              const parallel::CellIndex& place) {
    const auto first =
        std::ranges::find_if(here, [](const auto& each) { return !std::isnan(each.kick.tried); });
    if (first != here.end()) add_one(counts, *first, place, here.size() == 1);
}

}  // namespace peterka::findings
