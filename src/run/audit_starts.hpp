// Some starts of an audited cell, each solved in full by an integrator: whether they end where the map says.
//
// The map counts where starts end and doesn't keep it of each one, so the cell is solved once more as it was.
// What falls into the neighbourhood of an attractor found before ends there in the map; the integrator knows of
// none.
#pragma once

#include <cstdint>

#include "map_file/audit_table.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Nothing is counted where the job has no [starts].
[[nodiscard]] map_file::AuditedStarts audit_starts(const scene::Scene& scene, std::int64_t row,
                                                   std::int64_t column);

}  // namespace peterka
