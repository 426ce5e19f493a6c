// How long settled motions last under the disturbances of [noise]: of a map's cells or, with [starts], of their
// attractors. Independent of the grouping of cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "cell/result.hpp"

namespace peterka::findings {

struct LifeFindings {
    std::int64_t motions = 0;                                      // with a mean life, or a bound of it
    std::int64_t others = 0;                                       // settled ones with none
    std::int64_t ending = 0;                                       // with a mean life
    double least_bound = std::numeric_limits<double>::infinity();  // of the others' bounds [s]
    // The shortest life [s] and its place.
    double shortest = std::numeric_limits<double>::infinity();
    double error = 0;
    std::int64_t row = -1;
    std::int64_t column = -1;

    // Of a stored cell or attractor.
    template <class Motion>
    void add(const Motion& motion, std::int64_t at_row, std::int64_t at_column) {
        if (!cell::has_period(motion.regime)) return;
        const bool ends = !std::isnan(motion.mean_life);
        if (!ends && std::isnan(motion.mean_life_least)) return add({.others = 1});
        if (!ends) return add({.motions = 1, .least_bound = motion.mean_life_least});
        add({.motions = 1,
             .ending = 1,
             .shortest = motion.mean_life,
             .error = motion.mean_life_error,
             .row = at_row,
             .column = at_column});
    }
    void add(const LifeFindings& other) {
        motions += other.motions;
        others += other.others;
        ending += other.ending;
        least_bound = std::min(least_bound, other.least_bound);
        if (std::tie(other.shortest, other.row, other.column) >= std::tie(shortest, row, column)) return;
        std::tie(shortest, error, row, column) = std::tie(other.shortest, other.error, other.row, other.column);
    }
};

}  // namespace peterka::findings
