// The tables of a sweep: one axis, and a branch for each gap and direction.
#pragma once

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_map.hpp"
#include "job/schema_noise.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_starts.hpp"
#include "job/schema_uncertainty.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Sweep& sweep, const Key& gaps, bool has_gaps) {
    if (has_gaps) {
        table.either_list({gaps, sweep.gap_ratio, gap_ratio.range},
                          {{gap_m.name, "gaps of the branches [m]", gaps.is_required() ? "[0.0, 1e-3]" : ""},
                           sweep.gap_m,
                           gap_m.range},
                          "either of them sets the gaps of the branches");
        table.rule({gap_ratio.name, gap_m.name}, [&] { return rule_of_gaps(sweep); });
    } else {
        for (const Quantity& other : {gap_ratio, gap_m}) {
            table.refuse(other.name,
                         "is what the axis runs over; a branch has all of its values; remove this key");
        }
    }
    table.choice({"direction",
                  "up or down: each point starts from the last one's state, the first from [start]; both: a "
                  "branch of each; independent: every point from [start]"},
                 sweep.direction);
    table.integer({"samples", "stroboscopic states and impacts stored for each point, at most"}, sweep.samples,
                  from_to<std::int64_t>(1, 65536, "a bifurcation diagram has a point or more per frequency"));
}

// The branches: a list of gaps, unless the gap is the axis or that of the operating point.
template <typename Walker>
void describe_branches(Walker& file, Job& job, bool axis_is_known) {
    const bool gap_is_axis = is_gap(column_key(job));
    const bool may_lack_gaps = gap_is_axis || !axis_is_known || file.has("operating_point");
    const Key gaps{gap_ratio.name, "gaps of the branches, gap/A0 [1]", may_lack_gaps ? "" : "[0.0, 1.0]"};
    file.table({.name = "sweep",
                .meaning = "the branches",
                .example = may_lack_gaps ? "" : "gap_ratio = [0.0, 1.0]",
                .example_in_si = "gap_m = [0.0, 1e-3]"},
               [&](auto& table) { describe(table, job.sweep, gaps, !gap_is_axis); });
    if (!axis_is_known) return file.skip({"operating_point"});
    describe_shared_place(file, job, !is_frequency(column_key(job)),
                          !gap_is_axis && job.sweep.gaps().empty() && file.has("operating_point"),
                          "belongs to a basin; a sweep has a list of gaps; remove this table");
}

template <typename Walker>
void describe_sweep(Walker& file, Job& job) {
    bool axis_is_known = true;
    const Key axis{.name = "axes",
                   .meaning = "axis of the sweep",
                   .example = "[axes.frequency_ratio]",
                   .example_in_si = "[axes.frequency_hz]"};
    file.table(axis, [&](auto& axes) {
        const auto chosen = axes.choose_axes(job);
        axis_is_known = chosen.are_known;
        if (chosen.count > 0) describe_axis(axes, job.columns, quantity(column_key(job)));
    });
    take_first_values(job);
    describe_branches(file, job, axis_is_known);
    describe_start(file, job);
    describe_starts(file, job);
    describe_uncertainty(file, job);
    describe_noise(file, job);
    file.refuse("refine", "is for maps; every point of a sweep starts from the one before; remove this table");
    file.rule({"axes", "sweep", "starts"}, [&] { return rule_of_samples(job); });
    file.rule({"axes", "sweep", "operating_point", "hammer", "cart"}, [&] { return rule_of_place(job); });
    file.rule({"sweep", "start", "operating_point", "hammer", "cart"}, [&] { return rule_of_rigid_stop(job); });
}

}  // namespace peterka::job
