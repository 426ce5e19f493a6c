// The branches of a sweep with the same gap: up and down if it is swept in both directions.
#pragma once

#include <cstdint>

#include "job/job.hpp"

namespace peterka::job {

[[nodiscard]] inline std::int64_t branches_of_a_gap(const Sweep& sweep) {
    return sweep.direction == Direction::both ? 2 : 1;
}

}  // namespace peterka::job
