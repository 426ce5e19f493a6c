// The tables of a curves job: those of a map, in whose cells orbits are searched for, and [curves].
#pragma once

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_map.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_settings.hpp"
#include "job/schema_starts.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Curves& curves) {
    table.integer({"max_period", "curves of orbits up to this q [forcing cycles]"}, curves.max_period,
                  from_to<std::int64_t>(1, 16, "longer orbits have curves too fine for any picture"));
    table.either_list(
        {{gap_ratio.name, "gaps at which the borders of the regimes are told to nine digits, gap/A0 [1]"},
         curves.gap_ratio,
         gap_ratio.range},
        {{gap_m.name, "gaps at which the borders of the regimes are told to nine digits [m]"},
         curves.gap_m,
         gap_m.range},
        "either of them sets the gaps");
}

// For a map, whose cells they do not change.
template <typename Walker>
void describe_borders(Walker& file, Job& job) {
    file.table({.name = "curves",
                .meaning = "curves whose places the summary tells, where it names a gap",
                .is_identity = false,
                .is_written = !job.curves.gaps().empty()},
               [&](auto& table) {
                   describe(table, job.curves);
                   table.refuse("edge_distance",
                                "is for curves, whose file has it of each cell of their coarse "
                                "map; remove this key");
               });
    file.rule({"curves", "axes", "contact", "hammer", "solver"}, [&] { return rule_of_borders(job); });
}

template <typename Walker>
void describe_certificate_of_curves(Walker& file, Job& job) {
    file.table(
        {.name = "certificate",
         .meaning = "proof in interval arithmetic of where curves have the gaps of [curves]",
         .is_written = job.certificate.cells > 0},
        [&](auto& table) {
            table.count_or_all({"cells", "\"all\", or any number: each such place is tried; 0 for none"},
                               job.certificate.cells, from_to<std::int64_t>(0, every_cell, "it counts cells"));
            table.refuse("starts",
                         "is for maps, basins and sweeps; curves are about no start; remove this key");
            table.refuse("attractors", "is for maps with [starts]; curves are about none; remove this key");
        });
    file.rule({"certificate", "curves"}, [&] { return rule_of_proved_crossings(job); });
}

template <typename Walker>
void describe_curves(Walker& file, Job& job) {
    describe_plane(file, job);
    file.table({"curves", "which curves are traced"}, [&](auto& table) {
        describe(table, job.curves);
        table.flag({"edge_distance",
                    "true: each cell of the coarse map is told how far along each axis its own motion ends or "
                    "changes"},
                   job.curves.edge_distance);
    });
    file.rule({"curves", "axes"}, [&] { return rule_of_window(job); });
    file.rule({"axes"}, [&] { return rule_of_coarse_map(job); });
    describe_solver(file, job);
    file.rule({"contact", "hammer", "solver"}, [&] { return rule_of_curves(job); });
    describe_plain_output(file, job.output, "are for maps; curves have fields of their own; remove this key");
    describe_starts(file, job);
    file.refuse("uncertainty", "is for maps and sweeps; curves are those of one rig; remove this table");
    file.refuse("noise", "is for maps and sweeps; curves are those of undisturbed motions; remove this table");
    file.refuse("refine", "is for maps; curves are exact, whatever the cells; remove this table");
    file.refuse("audit", "is for maps; each point of a curve has its residual; remove this table");
    describe_certificate_of_curves(file, job);
    file.refuse("study", "belongs to kind = \"study\"; curves compare nothing; remove this table");
    file.refuse("limits", "is for maps; cells that fail bear no curve; remove this table");
}

}  // namespace peterka::job
