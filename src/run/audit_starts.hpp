// Some starts of an audited cell, each solved in full by an integrator: whether they end where the map says.
//
// The map counts the ends of starts but doesn't keep each one, so the cell is first solved again in the same
// way. There, a start that enters the neighbourhood of an attractor found earlier ends on it; the integrator
// knows of none.
#pragma once

#include <cstdint>

#include "map_file/audit_table.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Nothing is counted if the job has no [starts].
[[nodiscard]] map_file::AuditedStarts audit_starts(const scene::Scene& scene, std::int64_t row,
                                                   std::int64_t column);

}  // namespace peterka
