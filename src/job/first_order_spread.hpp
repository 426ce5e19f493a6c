// How far what is uncertain in [uncertainty] spreads a result of a cell, to first order, and the share of each
// number: with the elasticities e and the covariances C of the numbers' relative deviations, the result's
// relative variance is the sum of e_i C_ij e_j (JCGM 100:2008, 5.2).
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "job/cell_numbers.hpp"

namespace peterka::job {

struct Elasticity {
    std::string_view key;  // as axes name it
    double value = 0;
};

struct FirstOrderSpread {
    double deviation = 0;        // relative standard deviation of the result
    std::vector<double> shares;  // of its variance, of each elasticity's number; 0 where it is certain
};

// Whether [uncertainty] spreads a number, in either of its units.
[[nodiscard]] bool is_uncertain(const Job& job, std::string_view key);

// Nothing where none of these numbers is uncertain, an uncertain number isn't among them, or it is 0 in this
// cell.
[[nodiscard]] std::optional<FirstOrderSpread> first_order_spread(const Job& job, const CellNumbers& numbers,
                                                                 std::span<const Elasticity> elasticities);

}  // namespace peterka::job
