// The tables of a sweep: frequencies along one axis, and a branch for each gap and direction.
#pragma once

#include <algorithm>

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Sweep& sweep) {
    table.numbers({gap_ratio.name, "gaps of the branches, gap/A0 [1]", "[0.0, 1.0]"}, sweep.gap_ratio,
                  gap_ratio.range);
    table.rule({gap_ratio.name}, [&] { return rule_of_gaps(sweep); });
    table.choice({"direction",
                  "up or down: each point starts from the last one's state, the first from [start]; both: a "
                  "branch of each; independent: every point from [start]"},
                 sweep.direction);
    table.integer({"samples", "stroboscopic states and impacts stored for each point, at most"}, sweep.samples,
                  from_to<std::int64_t>(1, 65536, "a bifurcation diagram has a point or more per frequency"));
}

template <typename Walker>
void describe_sweep(Walker& file, Job& job) {
    file.table({"axes", "frequencies of the sweep", "[axes.frequency_ratio]"}, [&](auto& axes) {
        axes.table({frequency_ratio.name, frequency_ratio.meaning, "from, to and points"},
                   [&](auto& table) { describe(table, job.columns, frequency_ratio); });
        axes.refuse(gap_ratio.name,
                    "is an axis of a map; a sweep has a list of gaps, [sweep] gap_ratio; "
                    "remove this table");
        constexpr auto why = "is an axis of a basin; a sweep starts at one place; give it under [start]";
        axes.refuse(displacement_ratio.name, why);
        axes.refuse(velocity_ratio.name, why);
    });
    file.table({"sweep", "the branches", "gap_ratio = [0.0, 1.0]"},
               [&](auto& table) { describe(table, job.sweep); });
    describe_start(file, job);
    file.refuse("operating_point", "belongs to a basin; a sweep has a list of gaps; remove this table");
    file.refuse("starts", "is for maps; a sweep goes from state to state; remove this table");
    file.refuse("refine", "is for maps; every point of a sweep starts from the one before; remove this table");
    file.rule({"axes", "sweep"}, [&] { return rule_of_samples(job.columns, job.sweep); });
    file.rule({"sweep", "start"}, [&] {
        const auto& gaps = job.sweep.gap_ratio;
        if (gaps.empty()) return std::string();  // a fault already
        return rule_of_rigid_stop(job.contact, "start.displacement_ratio", job.start.displacement_ratio,
                                  "the lowest sweep.gap_ratio", std::ranges::min(gaps));
    });
}

}  // namespace peterka::job
