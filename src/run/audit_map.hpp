// The audit of a finished map: a sample of its cells is solved again, with every term, by an independent
// engine.
#pragma once

#include <string>

#include "map_file/audit_table.hpp"
#include "map_file/map_file.hpp"
#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "scene/scene.hpp"
#include "support/stop_request.hpp"

namespace peterka {

// Collective, inside failing_ends_all, once all tiles are complete. Throws Stopped, on every rank, if a stop is
// requested before the end; the audited cells are kept.
void audit_map(const parallel::Session& session, const RunPlan& plan, const scene::Scene& scene,
               const StopRequest& stop, map_file::MapFile& file);

}  // namespace peterka
