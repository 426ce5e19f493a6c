// The table of a map or sweep that gives each cell more starts than one.
#pragma once

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
    table.numbers({displacement_ratio.name, "from and to, x(0)/A0, at most up to the gap [1]"},
                  starts.displacement_ratio, displacement_ratio.range);
    table.numbers({velocity_ratio.name, "from and to, x'(0)/(A0 omega) [1]"}, starts.velocity_ratio,
                  velocity_ratio.range);
    table.integer(
        {"attractors", "kept for each cell, those with the largest shares"}, starts.attractors,
        from_to<std::int64_t>(1, 64, "each takes room in every cell, and few cells have more than four"));
    table.rule({displacement_ratio.name},
               [&] { return rule_of_interval("starts.displacement_ratio", starts.displacement_ratio); });
    table.rule({velocity_ratio.name},
               [&] { return rule_of_interval("starts.velocity_ratio", starts.velocity_ratio); });
}

template <typename Walker>
void describe_starts(Walker& file, Job& job) {
    file.table({"starts", "more starts in each cell, which tell all its attractors"},
               [&](auto& table) { describe(table, job.starts); });
    file.rule({"axes", "starts", "operating_point", "cart"}, [&] { return rule_of_room(job); });
}

}  // namespace peterka::job
