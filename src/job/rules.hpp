// Rules over several keys of a job. Each returns what is wrong with the reason and a suggestion, or an empty
// text.
#pragma once

#include <string>
#include <string_view>

#include "job/job.hpp"

namespace peterka::job {

[[nodiscard]] std::string rule_of_direction(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_logarithm(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_resolution(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_engine(const Hammer& hammer, const Solver& solver);
[[nodiscard]] std::string rule_of_title(std::string_view title);

}  // namespace peterka::job
