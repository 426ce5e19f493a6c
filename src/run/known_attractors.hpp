// The attractors of a basin, found before its cells are solved: pilot starts on a coarse grid over the same
// plane are run in full. The same attractors are known on every rank and in every run of the job.
#pragma once

#include <optional>

#include "parallel/session.hpp"
#include "regime/attractor_table.hpp"
#include "scene/scene.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all. Empty for a map, whose cells each have attractors of their own. Throws
// Stopped, on every rank, if a stop is requested before the end.
[[nodiscard]] regime::AttractorTable find_known_attractors(const parallel::Session& session,
                                                           const scene::Scene& scene, const StopRequest& stop);

// The same attractors, found by this process alone.
[[nodiscard]] regime::AttractorTable find_known_attractors(const scene::Scene& scene);

}  // namespace peterka
