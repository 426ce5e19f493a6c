// The tables of a job that define how its cells are computed and what is stored of them.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, SteadyState& steady_state) {
    table.integer({"max_cycles", "budget of a cell [forcing cycles]"}, steady_state.max_cycles,
                  from_to<std::int64_t>(1, 1'000'000'000, "a cell needs a budget that it can spend"));
    table.integer(
        {"max_period", "largest period q looked for [forcing cycles]"}, steady_state.max_period,
        from_to<std::int64_t>(1, 1024, "every cycle of the longest period is remembered for each cell"));
    table.integer({"chaos_cycles",
                   "cycles before a cell may be called chaotic where the hammer may also come free for good; "
                   "elsewhere 0.3 of them [forcing cycles]"},
                  steady_state.chaos_cycles,
                  from_to<std::int64_t>(1, 1'000'000'000, "chaos shows only in a run of some length"));
}

// Errors that may be requested of an integrator.
inline constexpr Range<double> errors_asked_for =
    from_to(1e-12, 0.1,
            "cvode and arkode, which auto and an audit may need, too, add up rounding errors, and must stay a "
            "solution");

template <typename Walker>
void describe(Walker& table, Solver& solver) {
    table.choice({"engine", "how a trajectory is computed"}, solver.engine);
    table.number({"tolerance", "relative error asked for in peak force [1]"}, solver.tolerance,
                 errors_asked_for);
    table.number({"omit_tolerance", "what leaving a term out may change in peak force, 0 keeps all [1]"},
                 solver.omit_tolerance,
                 from_to(0.0, 1.0, "a relative change is a share of the peak force; 0 keeps every term"));
}

template <typename Walker>
void describe(Walker& table, Audit& audit) {
    table.integer({"cells", "cells solved again by an independent engine with every term, 0 for none"},
                  audit.cells,
                  from_to<std::int64_t>(0, 1'000'000,
                                        "an audited cell costs a thousand others, and a sample tells enough"));
}

template <typename Walker>
void describe(Walker& table, Certificate& certificate) {
    table.count_or_all({"cells", "cells tried, drawn from all, or \"all\"; 0 for none"}, certificate.cells,
                       from_to<std::int64_t>(0, every_cell, "it counts cells"));
    table.flag({.name = "starts",
                .meaning = "true: also that the start leads there, through all its impacts",
                .is_written = certificate.starts},
               certificate.starts);
    table.flag({.name = "many_digits",
                .meaning = "true: starts also with 130 digits, where doubles lose the way",
                .is_written = certificate.many_digits},
               certificate.many_digits);
    table.flag({.name = "attractors",
                .meaning = "true: also of each attractor on which [starts] end, or that is known besides",
                .is_written = certificate.attractors},
               certificate.attractors);
}

template <typename Walker>
void describe_solver(Walker& file, Job& job) {
    file.table({"solver", "engine and tolerances"}, [&](auto& table) {
        describe(table, job.solver);
        table.rule({"engine"}, [&] { return rule_of_engine(job.hammer, job.contact, job.solver); });
    });
}

template <typename Walker>
void describe_anonymous(Walker& table, Output& output) {
    table.flag({.name = "anonymous",
                .meaning = "true: the file names no hosts, and a trace's file no map",
                .is_identity = false},
               output.anonymous);
}

// For a job whose file has its own fields.
template <typename Walker>
void describe_plain_output(Walker& file, Output& output, std::string_view why_no_fields) {
    file.table({"output", "what the file holds"}, [&](auto& table) {
        describe_anonymous(table, output);
        table.refuse("fields", why_no_fields);
    });
}

// What a list of fields may hold.
inline std::string_view fields_on_request() {
    static const std::string text = [] {
        std::string names = "extra fields";
        for (const auto& field : Names<OptionalField>::all) {
            if (field.name.find("_elasticity_") != field.name.npos) continue;  // one for each number
            const bool is_first = field.value == OptionalField{};
            names += is_first ? ": " : ", ";
            names += field.name;
        }
        return names + "; of one number alone force_elasticity_KEY, as in force_elasticity_gap_m";
    }();
    return text;
}

// How a map, basin or sweep is computed, and what is stored.
template <typename Walker>
void describe_settings(Walker& file, Job& job) {
    describe_solver(file, job);
    file.table({"output", "what the file holds beyond the usual"}, [&](auto& table) {
        table.choices({"fields", fields_on_request()}, job.output.fields);
        describe_anonymous(table, job.output);
    });
    file.rule({"output"}, [&] { return rule_of_kick(job); });
    file.rule({"output", "contact"}, [&] { return rule_of_elasticities(job); });
    if (job.kind == Kind::sweep) {
        file.refuse("audit",
                    "is for maps and basins; a point of a sweep starts from the one before it; audit a map of "
                    "the same window; remove this table");
    } else {
        file.table({"audit", "an independent check of some cells, half of them where claims are weakest"},
                   [&](auto& table) { describe(table, job.audit); });
    }
    file.table({"certificate", "proof of labels and forces in interval arithmetic"},
               [&](auto& table) { describe(table, job.certificate); });
    file.rule({"certificate", "starts"}, [&] { return rule_of_proved_attractors(job); });
    file.rule({"certificate"}, [&] { return rule_of_proved_starts(job); });
    file.table({.name = "limits", .meaning = "when a run counts as failed", .is_identity = false},
               [&](auto& table) {
                   table.integer(
                       {"failed_cells", "more failed cells than this end the run with exit code 4"},
                       job.limits.failed_cells,
                       from_to<std::int64_t>(0, std::numeric_limits<std::int64_t>::max(), "it counts cells"));
               });
}

}  // namespace peterka::job
