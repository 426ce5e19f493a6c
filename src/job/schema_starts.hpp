// The table of a map or sweep that gives each cell several starts.
#pragma once

#include <utility>

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Starts& starts) {
    table.integer(
        {"count", "starts of each cell besides [start]; 0 for none"}, starts.count,
        from_to<std::int64_t>(0, 1'000'000,
                              "a million starts hardly ever miss an attractor with a hundred-thousandth of "
                              "the rectangle"));
    table.either_list({{displacement_ratio.name, "from and to, x(0)/A0, at most up to the gap [1]"},
                       starts.displacement_ratio,
                       displacement_ratio.range},
                      {{displacement_m.name, "from and to, x(0), at most up to the gap [m]"},
                       starts.displacement_m,
                       displacement_m.range},
                      "either of them sets the width of the rectangle");
    table.either_list(
        {{velocity_ratio.name, "from and to, x'(0)/(A0 omega) [1]"},
         starts.velocity_ratio,
         velocity_ratio.range},
        {{velocity_m_per_s.name, "from and to, x'(0) [m/s]"}, starts.velocity_m_per_s, velocity_m_per_s.range},
        "either of them sets the height of the rectangle");
    table.integer(
        {"attractors", "kept for each cell, those with the largest shares"}, starts.attractors,
        from_to<std::int64_t>(1, 64, "each takes room in every cell, and few cells have more than four"));
    for (const auto& side : {std::pair(displacement_ratio.name, &starts.displacement_ratio),
                             std::pair(displacement_m.name, &starts.displacement_m),
                             std::pair(velocity_ratio.name, &starts.velocity_ratio),
                             std::pair(velocity_m_per_s.name, &starts.velocity_m_per_s)}) {
        if (side.second->empty()) continue;  // in the other unit
        table.rule({side.first}, [&] { return rule_of_interval(side.first, *side.second); });
    }
}

template <typename Walker>
void describe_starts(Walker& file, Job& job) {
    file.table({"starts", "more starts in each cell, which tell all its attractors"},
               [&](auto& table) { describe(table, job.starts); });
    file.rule({"axes", "starts", "operating_point", "cart"}, [&] { return rule_of_room(job); });
    file.rule({"axes", "start", "starts", "hammer", "cart"}, [&] { return rule_of_starts(job); });
}

}  // namespace peterka::job
