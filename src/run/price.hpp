// The resources that a map, a basin, a sweep or curves need, as reported by `check` and required by `run`.
#pragma once

#include <cstdint>
#include <string>

#include "job/job.hpp"

namespace peterka {

// Memory of a rank, on any number of ranks [bytes].
[[nodiscard]] std::int64_t memory_per_rank(const job::Job& job);

// For a job of curves, whose number is known only once they are traced [bytes].
[[nodiscard]] std::int64_t largest_curves_file(const job::Job& job);

// The time that [certificate] takes, as a line of check; empty if not requested.
[[nodiscard]] std::string certificate_price(const job::Job& job);

// The time that [certificate] takes for each place where a curve has a gap of [curves], whose number is known
// only once they are traced, as a line of check; empty if not requested.
[[nodiscard]] std::string crossings_price(const job::Job& job);

// The time that all cells take, foretold from some of them, as a line of check.
[[nodiscard]] std::string time_price(const job::Job& job);

// The number of [starts], and the time that critical kicks take, as lines of check; empty if there are none.
[[nodiscard]] std::string starts_price(const job::Job& job);

// The number of rigs drawn for [uncertainty], as a line of check; empty if there are none.
[[nodiscard]] std::string rigs_price(const job::Job& job);

// What following the settled motions under [noise] costs, as a line of check; empty without it.
[[nodiscard]] std::string noise_price(const job::Job& job);

// The cost of telling chaos from a long transient where max_cycles are too few for that in this rig, as a line
// of check; empty if they suffice.
[[nodiscard]] std::string long_chaos_price(const job::Job& job);

}  // namespace peterka
