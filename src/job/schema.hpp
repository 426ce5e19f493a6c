// The job file, once: every table, key, range, default and rule of it.
//
// `describe` walks a job with a reader (table_reader.hpp), which fills it from a file, or with a writer
// (table_writer.hpp), which prints it. Defaults are those of the structs in job.hpp.
#pragma once

#include <array>
#include <limits>
#include <variant>

#include <fmt/format.h>

#include "job/derived.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"

namespace peterka::job {

inline constexpr std::int64_t schema_version = 1;

// Quantities that stand on an axis, at an operating point or in a start.
struct Quantity {
    std::string_view name;
    std::string_view meaning;
    Range<double> range;
    std::string_view from;  // examples
    std::string_view to;
};

inline constexpr Quantity frequency_ratio{
    "frequency_ratio", "excitation frequency over natural frequency, Omega/omega [1]",
    from_to(1e-6, 1e6, "the cart must vibrate, and a cycle may last at most a million times the hammer's own"),
    "0.5", "4.5"};
inline constexpr Quantity gap_ratio{
    "gap_ratio", "gap over cart amplitude, gap/A0 [1]",
    from_to(-1e6, 1e6,
            "the stop stands within reach of the hammer, in front of it or (negative) pressed into it"),
    "0.0", "5.0"};
inline constexpr Quantity displacement_ratio{
    "displacement_ratio", "start of the hammer, x(0)/A0 [1]",
    from_to(-1e9, 1e9, "a start further away loses the cart's motion in rounding"), "-6.0", "6.0"};
inline constexpr Quantity velocity_ratio{
    "velocity_ratio", "start of the hammer, x'(0)/(A0 omega) [1]",
    from_to(-1e9, 1e9, "a faster start loses the cart's motion in rounding"), "-6.0", "6.0"};

template <typename Walker>
void describe(Walker& table, Hammer& hammer) {
    table.number({"mass_kg", "mass of the hammer [kg]", "0.298"}, hammer.mass_kg,
                 positive("a mass must be positive: the hammer has inertia"));
    table.either({{"natural_frequency_hz", "natural frequency sqrt(k/m)/(2 pi), no contact [Hz]", "4.5"},
                  hammer.natural_frequency_hz,
                  positive("a natural frequency must be positive: the springs pull the hammer back")},
                 {{"stiffness_n_per_m", "stiffness k of the beam springs [N/m]", "238.0"},
                  hammer.stiffness_n_per_m,
                  positive("a stiffness must be positive: the springs pull the hammer back")},
                 "either of them sets the stiffness of the beam springs");
    table.either({{"damping_ns_per_m", "damping c of the beam springs [Ns/m]", "0.06"},
                  hammer.damping_ns_per_m,
                  not_negative("a damping must not be negative: beam springs take energy and give none")},
                 {{"damping_ratio", "damping ratio c/(2 sqrt(k m)) of the beam springs [1]", "0.004"},
                  hammer.damping_ratio,
                  not_negative("a damping ratio must not be negative: beam springs take energy and give none")},
                 "either of them sets the damping of the beam springs");
    table.number(
        {"cubic_stiffness_n_per_m3", "cubic stiffness k3 [N/m^3]"}, hammer.cubic_stiffness_n_per_m3,
        from_to(-largest_magnitude, largest_magnitude, "a cubic stiffness is a finite physical magnitude"));
    table.choice({"cubic", "form of the cubic term: relative k3 (x - y)^3, absolute k3 (x^3 - y^3)"},
                 hammer.cubic);
}

template <typename Walker>
void describe(Walker& table, Cart& cart) {
    table.number(
        {"amplitude_m", "amplitude A0 of the cart, y = A0 sin(Omega t) [m]", "0.89e-3"}, cart.amplitude_m,
        positive(
            "an amplitude must be positive: a cart at rest drives nothing, and lengths are counted in it"));
}

template <typename Walker>
void describe(Walker& table, KelvinVoigt& stop) {
    table.number({"stiffness_n_per_m", "stiffness ki of the stop [N/m]", "5.5e6"}, stop.stiffness_n_per_m,
                 positive("a contact stiffness must be positive: the stop pushes the hammer back"));
    table.number({"damping_ns_per_m", "damping ci of the stop [Ns/m]", "1.2e3"}, stop.damping_ns_per_m,
                 not_negative("a contact damping must not be negative: a stop takes energy and gives none"));
}

template <typename Walker>
void describe(Walker& table, Restitution& stop) {
    table.number(
        {"coefficient", "coefficient of restitution r, speed after over speed before an impact [1]", "0.6"},
        stop.coefficient, from_to(0.0, 1.0, "a rigid stop takes energy and gives none"));
}

template <typename Walker>
void describe(Walker& table, HuntCrossley& stop) {
    table.number({"stiffness_n_per_m_pow_n", "stiffness K of F = K delta^n (1 + D delta') [N/m^n]", "5.5e8"},
                 stop.stiffness_n_per_m_pow_n,
                 positive("a contact stiffness must be positive: the stop pushes the hammer back"));
    table.number({"exponent", "exponent n, 1.5 for Hertz's contact of spheres [1]"}, stop.exponent,
                 from_to(1.0, 10.0, "below 1 the stop would be infinitely stiff at first touch"));
    table.number({"dissipation_s_per_m", "dissipation D [s/m]", "0.3"}, stop.dissipation_s_per_m,
                 not_negative("a dissipation must not be negative: a stop takes energy and gives none"));
}

// The keys of all laws, for what to say of them under another one.
struct StopKey {
    std::string_view name;
    ContactLaw law;
};
inline constexpr std::array stop_keys{StopKey{"stiffness_n_per_m", ContactLaw::kelvin_voigt},
                                      StopKey{"damping_ns_per_m", ContactLaw::kelvin_voigt},
                                      StopKey{"coefficient", ContactLaw::restitution},
                                      StopKey{"stiffness_n_per_m_pow_n", ContactLaw::hunt_crossley},
                                      StopKey{"exponent", ContactLaw::hunt_crossley},
                                      StopKey{"dissipation_s_per_m", ContactLaw::hunt_crossley}};

template <typename Walker>
void describe(Walker& table, Contact& contact) {
    auto law = law_of(contact);
    const bool known =
        table.choice({"law", "contact law of the stop, which pushes and never pulls", "\"kelvin_voigt\""}, law);
    // The other keys are those of a law; without one they would only add faults that mean nothing.
    if (!known) {
        for (const StopKey& key : stop_keys) table.skip({key.name});
        return;
    }
    if (law != law_of(contact) && law == ContactLaw::restitution) contact = Restitution{};
    if (law != law_of(contact) && law == ContactLaw::hunt_crossley) contact = HuntCrossley{};
    for (const StopKey& key : stop_keys) {
        if (key.law != law) table.refuse(key.name, reason_for_other_law(key.law));
    }
    std::visit([&](auto& stop) { describe(table, stop); }, contact);
}

template <typename Walker>
void describe(Walker& table, Axis& axis, const Quantity& quantity) {
    table.number({"from", "first value", quantity.from}, axis.from, quantity.range);
    table.number({"to", "last value", quantity.to}, axis.to, quantity.range);
    table.integer({"points", "number of values, both ends included", "512"}, axis.points,
                  from_to<std::int64_t>(2, std::numeric_limits<std::int32_t>::max(),
                                        "an axis has two ends, and its points are counted in 32 bits"));
    table.choice({"scale", "spacing of the values, linear or log"}, axis.scale);
    table.rule({"from", "to"}, [&] { return rule_of_direction(quantity.name, axis); });
    table.rule({"from", "scale"}, [&] { return rule_of_logarithm(quantity.name, axis); });
    table.rule({"from", "to", "points", "scale"}, [&] { return rule_of_resolution(quantity.name, axis); });
}

template <typename Walker>
void describe_axes(Walker& axes, Job& job, const Quantity& columns, const Quantity& rows) {
    axes.table({columns.name, columns.meaning, "from, to and points"},
               [&](auto& table) { describe(table, job.columns, columns); });
    axes.table({rows.name, rows.meaning, "from, to and points"},
               [&](auto& table) { describe(table, job.rows, rows); });
}

// The plane of a map and the start of its cells.
template <typename Walker>
void describe_plane(Walker& file, Job& job) {
    file.table({"axes", "plane of the map", "[axes.frequency_ratio] and [axes.gap_ratio]"}, [&](auto& axes) {
        describe_axes(axes, job, frequency_ratio, gap_ratio);
        constexpr auto why =
            "is an axis of a basin; a map starts every cell alike; give one value under [start]";
        axes.refuse(displacement_ratio.name, why);
        axes.refuse(velocity_ratio.name, why);
    });
    file.table({"start", "start of the hammer at t = 0, absolute (not relative to the cart)"},
               [&](auto& table) {
                   table.number({displacement_ratio.name, displacement_ratio.meaning},
                                job.start.displacement_ratio, displacement_ratio.range);
                   table.number({velocity_ratio.name, velocity_ratio.meaning}, job.start.velocity_ratio,
                                velocity_ratio.range);
               });
}

template <typename Walker>
void describe_map(Walker& file, Job& job) {
    describe_plane(file, job);
    file.table({"refine", "cells that are filled from those around them instead of being computed"},
               [&](auto& table) { describe(table, job.refine); });
    file.refuse("operating_point", "belongs to a basin; a map covers the plane of its axes; remove this table");
    file.rule({"axes"}, [&] {
        return rule_of_rigid_stop(job.contact, "start.displacement_ratio", job.start.displacement_ratio,
                                  "the lowest axes.gap_ratio", job.rows.from);
    });
}

template <typename Walker>
void describe_basin(Walker& file, Job& job) {
    file.table(
        {"operating_point", "place in the plane at which the basin is drawn", "frequency_ratio and gap_ratio"},
        [&](auto& table) {
            table.number({frequency_ratio.name, frequency_ratio.meaning, "1.8"},
                         job.operating_point.frequency_ratio, frequency_ratio.range);
            table.number({gap_ratio.name, gap_ratio.meaning, "1.6"}, job.operating_point.gap_ratio,
                         gap_ratio.range);
        });
    file.table({"axes", "plane of starts", "[axes.displacement_ratio] and [axes.velocity_ratio]"},
               [&](auto& axes) {
                   describe_axes(axes, job, displacement_ratio, velocity_ratio);
                   constexpr auto why =
                       "is an axis of a map; a basin is drawn at one place; give one value under "
                       "[operating_point]";
                   axes.refuse(frequency_ratio.name, why);
                   axes.refuse(gap_ratio.name, why);
               });
    file.refuse("start", "belongs to a map; a basin starts from every point of its axes; remove this table");
    file.refuse("refine",
                "is for maps; the edges of basins are fractal, so every start is computed; remove this table");
    file.rule({"axes"}, [&] {
        return rule_of_rigid_stop(job.contact, "axes.displacement_ratio.to", job.columns.to,
                                  "operating_point.gap_ratio", job.operating_point.gap_ratio);
    });
}

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

template <typename Walker>
void describe(Walker& table, Solver& solver) {
    table.choice({"engine", "how a trajectory is computed"}, solver.engine);
    table.number({"tolerance", "relative error asked for in peak force [1]"}, solver.tolerance,
                 between(0.0, 1.0, "a relative error of 0 is never reached, and one of 1 says nothing"));
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
void describe(Walker& table, Refine& refine) {
    table.integer(
        {"levels", "first every 2^levels-th cell, then only where needed; 0 computes every cell"},
        refine.levels,
        from_to<std::int64_t>(0, 6, "on a coarser grid than every 64th cell whole regions go unseen"));
}

// Of a map or a basin: how it is computed, and what is stored.
template <typename Walker>
void describe_settings(Walker& file, Job& job) {
    file.table({"solver", "engine and tolerances"}, [&](auto& table) {
        describe(table, job.solver);
        table.rule({"engine"}, [&] { return rule_of_engine(job.hammer, job.contact, job.solver); });
    });
    file.table({"output", "what the file holds beyond the usual"}, [&](auto& table) {
        table.choices(
            {"fields",
             "extra fields: multiplier, lyapunov, sensitivity, orbit, impact_speed, impulse, contact_time, "
             "contact_power_w, max_displacement, force_per_cycle"},
            job.output.fields);
    });
    file.table({"audit", "an independent check of a random sample of cells"},
               [&](auto& table) { describe(table, job.audit); });
    file.table({.name = "limits", .meaning = "when a run counts as failed", .is_identity = false},
               [&](auto& table) {
                   table.integer(
                       {"failed_cells", "more failed cells than this end the run with exit code 4"},
                       job.limits.failed_cells,
                       from_to<std::int64_t>(0, std::numeric_limits<std::int64_t>::max(), "it counts cells"));
               });
}

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
        return table.skip(
            {"frequency_ratio", "gap_ratio", "tolerances", "steps_per_cycle", "cycles", "repeats"});
    }
    if (study.topic == StudyTopic::stability) {
        table.refuse("tolerances",
                     "belongs to other topics; a stability study asks for solver.tolerance; remove it");
    } else {
        table.numbers(
            {"tolerances", "relative errors in peak force that integrators are asked for [1]"},
            study.tolerances,
            from_to(1e-12, 0.1, "an integrator's steps add up rounding errors, and must stay a solution"));
    }
    if (study.topic != StudyTopic::work_precision) {
        constexpr auto why = "belongs to topic = \"work_precision\"; only that follows single cells; remove it";
        for (const auto* name : {"frequency_ratio", "gap_ratio", "steps_per_cycle", "cycles", "repeats"}) {
            table.refuse(name, why);
        }
        return;
    }
    table.numbers({frequency_ratio.name, "excitation frequencies of the cells, Omega/omega [1]"},
                  study.frequency_ratio, frequency_ratio.range);
    table.numbers({gap_ratio.name, "gaps of the cells, gap/A0 [1]"}, study.gap_ratio, gap_ratio.range);
    table.rule({frequency_ratio.name, gap_ratio.name}, [&] { return rule_of_cells(study); });
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
            table.number(
                {"tolerance", "relative error asked for in peak force [1]"}, job.solver.tolerance,
                from_to(1e-12, 0.1, "an integrator's steps add up rounding errors, and must stay a solution"));
            for (const auto* name : {"engine", "omit_tolerance"}) {
                table.refuse(name, "is for maps; a study runs every engine with every term; remove it");
            }
        });
    } else {
        file.refuse("solver",
                    "is for maps; a study runs every engine at its study.tolerances; remove this table");
    }
    file.refuse("operating_point", "belongs to a basin; a study has scenes of its own; remove this table");
    file.refuse("output", "is for maps; a study has fields of its own; remove this table");
    file.refuse("refine", "is for maps; a study compares computed cells; remove this table");
    file.refuse("audit", "is for maps; a study is an audit itself; remove this table");
    file.refuse("limits", "is for maps; a study tells failures as results; remove this table");
}

// Tables of kinds that are named already; saying so helps more than "unknown table".
template <typename Walker>
void refuse_later_tables(Walker& file) {
    for (const auto* name : {"sweep", "trace"}) {
        file.refuse(name, "is not in this version; it computes maps, basins and studies; remove this table");
    }
}

template <typename Walker>
void describe(Walker& file, Job& job) {
    std::int64_t schema = schema_version;
    file.integer({"schema", "version of the job file's own format", "1"}, schema,
                 from_to(schema_version, schema_version, "this version reads job files of schema 1 only"));
    const bool kind_is_known =
        file.choice({"kind", "kind of the job: map, basin or study", "\"map\""}, job.kind);
    file.text({.name = "title", .meaning = "title of pictures and reports", .is_identity = false}, job.title);
    file.rule({"title"}, [&] { return rule_of_title(job.title); });

    file.table({"hammer", "mass, springs and damping of the hammer", "mass_kg = 0.298"},
               [&](auto& table) { describe(table, job.hammer); });
    file.table({"cart", "motion of the cart", "amplitude_m = 0.89e-3"},
               [&](auto& table) { describe(table, job.cart); });
    file.table({"contact", "law and numbers of the stop", "law = \"kelvin_voigt\""},
               [&](auto& table) { describe(table, job.contact); });
    file.note([&] { return derived_numbers_in_words(job); });

    if (!kind_is_known) file.skip({"axes", "start", "operating_point", "refine", "study"});
    if (kind_is_known && job.kind == Kind::map) describe_map(file, job);
    if (kind_is_known && job.kind == Kind::basin) describe_basin(file, job);
    file.table({"steady_state", "when a regime counts as proved"},
               [&](auto& table) { describe(table, job.steady_state); });
    if (kind_is_known && job.kind == Kind::study) {
        describe_study(file, job);
    } else {
        describe_settings(file, job);
        if (kind_is_known)
            file.refuse("study",
                        "belongs to kind = \"study\"; a map or basin has one engine and compares none; remove "
                        "this table");
    }
    refuse_later_tables(file);
}

}  // namespace peterka::job
