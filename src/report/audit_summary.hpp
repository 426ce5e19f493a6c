// The result of an audit, for a map's summary.
#pragma once

#include <string>

#include "map_file/audit_table.hpp"

namespace peterka {

// seconds_per_cell: of the map itself, on average.
[[nodiscard]] std::string audit_summary(const map_file::AuditReport& audit, double seconds_per_cell);

}  // namespace peterka
