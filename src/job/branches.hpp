// The branches of a sweep that have a gap in common: up and down, where it goes both ways.
#pragma once

#include <cstdint>

#include "job/job.hpp"

namespace peterka::job {

[[nodiscard]] inline std::int64_t branches_of_a_gap(const Sweep& sweep) {
    return sweep.direction == Direction::both ? 2 : 1;
}

}  // namespace peterka::job
