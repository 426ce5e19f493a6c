// The computation of a run: the tiles that the map file lacks are dealt to all ranks, solved and stored.
#pragma once

#include "map_file/map_file.hpp"
#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "scene/scene.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all. Throws Stopped, on every rank, if a stop is requested before the end.
void solve_missing_tiles(const parallel::Session& session, const RunPlan& plan, const scene::Scene& scene,
                         const StopRequest& stop, map_file::MapFile& file);

}  // namespace peterka
