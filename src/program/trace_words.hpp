// What came out of a trace, on one screen.
#pragma once

#include <optional>
#include <string>

#include "output/map_cell.hpp"
#include "trace/trace.hpp"

namespace peterka {

[[nodiscard]] std::string trace_in_words(const scene::Scene& scene, const trace::Trace& trace,
                                         const std::optional<output::MapCell>& map);

}  // namespace peterka
