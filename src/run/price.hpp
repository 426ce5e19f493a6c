// What a map, a basin, a sweep or curves take of the machine, as `check` tells it and `run` wants it to be
// there.
#pragma once

#include <cstdint>
#include <string>

#include "job/job.hpp"

namespace peterka {

// Of a rank, on any number of ranks [bytes].
[[nodiscard]] std::int64_t memory_per_rank(const job::Job& job);

// Of a job of curves, which knows their number only once they are traced [bytes].
[[nodiscard]] std::int64_t largest_curves_file(const job::Job& job);

// What [certificate] costs in time, as a line of check; nothing where it isn't wanted.
[[nodiscard]] std::string certificate_price(const job::Job& job);

// What [starts] cost in time, as a line of check; nothing where there are none.
[[nodiscard]] std::string starts_price(const job::Job& job);

// What it takes to tell chaos from a long transient where max_cycles are too few for that in this rig, as a
// line of check; nothing where they aren't.
[[nodiscard]] std::string long_chaos_price(const job::Job& job);

}  // namespace peterka
