// The results of a trace, on one screen.
#pragma once

#include <optional>
#include <string>

#include "map_file/map_cell.hpp"
#include "trace/trace.hpp"

namespace peterka {

[[nodiscard]] std::string trace_in_words(const scene::Scene& scene, const trace::Trace& trace,
                                         const std::optional<map_file::MapCell>& map);

}  // namespace peterka
