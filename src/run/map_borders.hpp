// The borders of a map's regimes at the gaps that its job names, from curves traced in its window.
#pragma once

#include <string>

#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all; once the file is complete. In words; empty if not requested.
[[nodiscard]] std::string map_borders(const parallel::Session& session, const RunPlan& plan,
                                      const StopRequest& stop);

}  // namespace peterka
