// Tasks whose results are plain numbers: dealt to all ranks, with all results returned to every rank.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "parallel/session.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all. Returns the results of tasks 0 to count - 1, in this order; throws
// Stopped, on every rank, if a stop is requested before the end. `on_progress` is called on rank 0 with the
// number of tasks that any rank has solved since the last call.
[[nodiscard]] std::vector<std::vector<double>> deal_numbers(
    const parallel::Session& session, const StopRequest& stop, std::int64_t count,
    const std::function<std::vector<double>(std::int64_t task)>& solve,
    const std::function<void(std::int64_t tasks)>& on_progress);

}  // namespace peterka
