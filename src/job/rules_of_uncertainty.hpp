// Rules over the keys of [uncertainty]. Each returns what is wrong, the reason and a suggestion, or an empty
// string.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// The tables and keys of what may be uncertain with a stop of this law.
[[nodiscard]] std::vector<std::string> uncertain_keys(ContactLaw law);

// `name`: table and key of the number.
[[nodiscard]] std::string rule_of_spread(std::string_view name, const Spread& spread);
[[nodiscard]] std::string rule_of_covariance(const Covariance& covariance);
[[nodiscard]] std::string rule_of_rigs(const Uncertainty& uncertainty);
// What is uncertain fits the job's rig and axes, and draws lie in the ranges of the keys.
[[nodiscard]] std::string rule_of_uncertainty(const Job& job);

}  // namespace peterka::job
