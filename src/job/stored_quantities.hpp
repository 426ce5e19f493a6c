// Which quantities of its cells a job stores.
#pragma once

#include <span>
#include <vector>

#include "cell/quantities.hpp"
#include "job/job.hpp"

namespace peterka::job {

// A basin always stores the orbit: it tells attractors apart.
[[nodiscard]] bool stores(const Job& job, const cell::Quantity& quantity);

// In the order of the table.
[[nodiscard]] std::vector<const cell::Quantity*> stored_quantities(const Job& job);

// For each attractor of a cell; none without [starts].
[[nodiscard]] std::vector<const cell::AttractorQuantity*> stored_attractor_quantities(const Job& job);

// For each outcome of the rigs drawn for a cell; none without [uncertainty].
[[nodiscard]] std::span<const cell::OutcomeQuantity> stored_outcome_quantities(const Job& job);

}  // namespace peterka::job
