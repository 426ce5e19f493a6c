// The tables of a study: what is compared, and how.
#pragma once

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_map.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_settings.hpp"

namespace peterka::job {

// The keys of a study that only some topics have.
template <typename Walker>
void describe(Walker& table, Study& study) {
    const bool known =
        table.choice({"topic",
                      "what is compared: work_precision (error against time), labels (regimes of "
                      "a map) or stability (extreme scenes)",
                      "\"work_precision\""},
                     study.topic);
    if (!known) {
        return table.skip({"frequency_ratio", "gap_ratio", "frequency_hz", "gap_m", "tolerances",
                           "steps_per_cycle", "cycles", "repeats"});
    }
    if (study.topic == StudyTopic::stability) {
        table.refuse("tolerances",
                     "belongs to other topics; a stability study asks for solver.tolerance; remove it");
    } else {
        table.numbers({"tolerances", "relative errors in peak force that integrators are asked for [1]"},
                      study.tolerances, errors_asked_for);
    }
    if (study.topic != StudyTopic::work_precision) {
        constexpr auto why = "belongs to topic = \"work_precision\"; only that follows single cells; remove it";
        for (const auto* name : {"frequency_ratio", "gap_ratio", "frequency_hz", "gap_m", "steps_per_cycle",
                                 "cycles", "repeats"}) {
            table.refuse(name, why);
        }
        return;
    }
    table.either_list({{frequency_ratio.name, "excitation frequencies of the cells, Omega/omega [1]"},
                       study.frequency_ratio,
                       frequency_ratio.range},
                      {{frequency_hz.name, "excitation frequencies of the cells [Hz]"},
                       study.frequency_hz,
                       frequency_hz.range},
                      "either of them sets the frequencies of the cells");
    table.either_list({{gap_ratio.name, "gaps of the cells, gap/A0 [1]"}, study.gap_ratio, gap_ratio.range},
                      {{gap_m.name, "gaps of the cells [m]"}, study.gap_m, gap_m.range},
                      "either of them sets the gaps of the cells");
    table.rule({frequency_ratio.name, frequency_hz.name, gap_ratio.name, gap_m.name},
               [&] { return rule_of_cells(study); });
    table.integers({"steps_per_cycle", "of the methods with a fixed step"}, study.steps_per_cycle,
                   from_to<std::int64_t>(1, 10'000'000, "a cycle is cut into whole steps"));
    table.integer({"cycles", "followed and timed in each run [forcing cycles]"}, study.cycles,
                  from_to<std::int64_t>(1, 1'000'000, "a run lasts whole forcing cycles"));
    table.integer({"repeats", "of each run, the fastest of which counts"}, study.repeats,
                  from_to<std::int64_t>(1, 1000, "a time is measured at least once"));
}

template <typename Walker>
void describe_study(Walker& file, Job& job) {
    file.table({"study", "what is compared, and how", "topic = \"work_precision\""},
               [&](auto& table) { describe(table, job.study); });
    file.rule({"study"}, [&] { return rule_of_study(job.contact); });
    file.rule({"study", "hammer", "cart"}, [&] { return rule_of_place(job); });
    if (job.study.topic == StudyTopic::labels) {
        describe_plane(file, job);
    } else {
        constexpr auto why =
            "belongs to a map, a basin or a study of labels; this topic has scenes of its own; remove this "
            "table";
        file.refuse("axes", why);
        file.refuse("start", why);
    }
    if (job.study.topic == StudyTopic::stability) {
        file.table({"solver", "what is asked of the engines"}, [&](auto& table) {
            table.number({"tolerance", "relative error asked for in peak force [1]"}, job.solver.tolerance,
                         errors_asked_for);
            for (const auto* name : {"engine", "omit_tolerance"}) {
                table.refuse(name, "is for maps; a study runs every engine with every term; remove it");
            }
        });
    } else {
        file.refuse("solver",
                    "is for maps; a study runs every engine at its study.tolerances; remove this table");
    }
    file.refuse("operating_point", "belongs to a basin; a study has scenes of its own; remove this table");
    describe_plain_output(file, job.output, "are for maps; a study has fields of its own; remove this key");
    file.refuse("uncertainty",
                "is for maps and sweeps; a study compares engines on one rig; remove this table");
    file.refuse("noise",
                "is for maps and sweeps; a study compares engines on undisturbed motions; remove this table");
    file.refuse("starts", "is for maps; a study compares single starts; remove this table");
    file.refuse("refine", "is for maps; a study compares computed cells; remove this table");
    file.refuse("audit", "is for maps; a study is an audit itself; remove this table");
    file.refuse("certificate", "is for maps, basins and sweeps; a study stores no orbits; remove this table");
    file.refuse("limits", "is for maps; a study tells failures as results; remove this table");
}

}  // namespace peterka::job
