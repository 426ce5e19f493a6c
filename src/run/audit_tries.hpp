// Some starts, and some of the rigs drawn, of an audited cell, each solved in full by an integrator: whether
// they end where the map says.
//
// The map counts ends but doesn't keep each one, so the cell is first solved again in the same way. There, a
// start that enters the neighbourhood of an attractor found earlier ends on it; the integrator knows of none.
#pragma once

#include <cstdint>

#include "map_file/audit_table.hpp"
#include "scene/scene.hpp"

namespace peterka {

struct AuditedCell {
    map_file::AuditedTries starts;  // none without [starts]
    map_file::AuditedTries rigs;    // none without [uncertainty]
};

// A pure function of scene and cell, which must be a computed one.
[[nodiscard]] AuditedCell audit_tries(const scene::Scene& scene, std::int64_t row, std::int64_t column);

}  // namespace peterka
