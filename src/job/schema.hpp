// The single definition of the job file: its tables, keys, ranges, defaults and rules. The tables of each kind
// of job, and those that kinds share, are described in schema_*.hpp.
//
// `describe` walks a job with a reader (table_reader.hpp), which fills it from a file, or with a writer
// (table_writer.hpp), which prints it. Defaults are those of the structs in job.hpp.
#pragma once

#include "job/derived_in_words.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_cell_of_map.hpp"
#include "job/schema_curves.hpp"
#include "job/schema_map.hpp"
#include "job/schema_noise.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_rig.hpp"
#include "job/schema_settings.hpp"
#include "job/schema_starts.hpp"
#include "job/schema_study.hpp"
#include "job/schema_sweep.hpp"
#include "job/schema_trace.hpp"
#include "job/schema_uncertainty.hpp"

namespace peterka::job {

inline constexpr std::int64_t schema_version = 1;

template <typename Walker>
void describe_rig(Walker& file, Job& job) {
    file.table({"hammer", "mass, springs and damping of the hammer", "mass_kg = 0.298"},
               [&](auto& table) { describe(table, job.hammer); });
    file.table({"cart", "motion of the cart", "amplitude_m = 0.89e-3"},
               [&](auto& table) { describe(table, job.cart); });
    file.table({"contact", "law and numbers of the stop", "law = \"kelvin_voigt\""},
               [&](auto& table) { describe(table, job.contact); });
    file.note([&] { return derived_numbers_in_words(job); });
}

template <typename Walker>
void describe_trace(Walker& file, Job& job) {
    file.table({"trace", "which cell is followed, and what is shown of it"}, [&](auto& table) {
        describe_cell_of_map(
            table, job.cell,
            {"map", "file of a map or basin with the cell to follow, \"\" for the rig of this job"}, "trace");
        describe(table, job.trace);
    });
    if (!job.cell.map.empty()) {
        describe_trace_of_map(file, job);
    } else {
        describe_rig(file, job);
        describe_trace_of_rig(file, job);
        file.table({"steady_state", "when a regime counts as verified"},
                   [&](auto& table) { describe(table, job.steady_state); });
        describe_solver(file, job);
    }
    describe_plain_output(file, job.output, "are for maps; a trace stores all it has; remove this key");
    refuse_other_tables_in_trace(file);
}

template <typename Walker>
void describe(Walker& file, Job& job) {
    std::int64_t schema = schema_version;
    file.integer({"schema", "version of the job file's own format", "1"}, schema,
                 from_to(schema_version, schema_version, "this version reads job files of schema 1 only"));
    const bool kind_is_known = file.choice(
        {"kind", "kind of the job: map, basin, sweep, study, trace or curves", "\"map\""}, job.kind);
    file.text({.name = "title", .meaning = "title of pictures and reports", .is_identity = false}, job.title);
    file.rule({"title"}, [&] { return rule_of_title(job.title); });
    file.skip({"rig"});  // followed before anything is read (rig_files.hpp)

    if (kind_is_known && job.kind == Kind::trace) return describe_trace(file, job);
    if (kind_is_known && has_any_axes(job.kind)) file.leave_to_axes(job);
    if (kind_is_known && job.kind == Kind::basin) describe_basin_of_map(file, job);
    if (job.cell.map.empty()) describe_rig(file, job);

    if (!kind_is_known) {
        file.skip({"axes", "start", "operating_point", "refine", "starts", "uncertainty", "noise", "sweep",
                   "study", "trace", "curves", "basin"});
    }
    if (kind_is_known && job.kind == Kind::map) {
        describe_map(file, job);
        describe_starts(file, job);
        describe_uncertainty(file, job);
        describe_noise(file, job);
    }
    if (kind_is_known && job.kind == Kind::basin) describe_basin(file, job);
    if (kind_is_known && job.kind == Kind::sweep) describe_sweep(file, job);
    if (kind_is_known && job.kind != Kind::sweep) {
        file.refuse("sweep", "belongs to kind = \"sweep\"; other jobs have no branches; remove this table");
    }
    file.table({"steady_state", "when a regime counts as verified"},
               [&](auto& table) { describe(table, job.steady_state); });
    if (kind_is_known && job.kind == Kind::study) {
        describe_study(file, job);
    } else if (kind_is_known && job.kind == Kind::curves) {
        describe_curves(file, job);
    } else {
        describe_settings(file, job);
        if (kind_is_known)
            file.refuse(
                "study",
                "belongs to kind = \"study\"; a map, basin or sweep has one engine and compares none; remove "
                "this table");
    }
    if (kind_is_known) {
        file.refuse("trace",
                    "belongs to kind = \"trace\"; this job follows no single cell in time; remove this table");
    }
    if (kind_is_known && job.kind != Kind::basin) {
        file.refuse(
            "basin",
            "belongs to kind = \"basin\"; it names a map whose rig and place a basin has; remove this table");
    }
    if (kind_is_known && job.kind == Kind::map) describe_borders(file, job);
    if (kind_is_known && job.kind != Kind::curves && job.kind != Kind::map) {
        file.refuse("curves", "belongs to maps and kind = \"curves\"; this job traces none; remove this table");
    }
}

}  // namespace peterka::job
