#include "job/rules.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "job/axis.hpp"
#include "job/branches.hpp"
#include "job/derived.hpp"
#include "job/names.hpp"
#include "job/settle.hpp"
#include "job/toml_text.hpp"
#include "support/escape_untrusted.hpp"

namespace peterka::job {

std::string rule_of_direction(std::string_view axis_name, const Axis& axis) {
    if (axis.from < axis.to || (axis.from == axis.to && axis.points == 1)) return {};
    const bool is_empty = axis.from == axis.to;
    return fmt::format("axes.{} runs from {} to {}; an axis {}; {}", axis_name, toml_text(axis.from),
                       toml_text(axis.to),
                       is_empty ? "of more than a point must have a length" : "runs upwards",
                       is_empty ? "give a larger to, or points = 1" : "swap from and to");
}

std::string rule_of_logarithm(std::string_view axis_name, const Axis& axis) {
    if (axis.scale != Spacing::log || axis.from > 0) return {};
    return fmt::format(
        "axes.{} is logarithmic from {}; only positive numbers have a logarithm; give a from above 0 "
        "or scale = \"linear\"",
        axis_name, toml_text(axis.from));
}

std::string rule_of_resolution(std::string_view axis_name, const Axis& axis) {
    if (resolves_its_points(axis)) return {};
    return fmt::format(
        "axes.{} has {} points from {} to {}; double precision cannot tell neighbours apart; give "
        "fewer points or a longer axis",
        axis_name, axis.points, toml_text(axis.from), toml_text(axis.to));
}

std::string rule_of_engine(const Hammer& hammer, const Contact& contact, const Solver& solver) {
    const bool closed_form = solver.engine == EngineChoice::exact || solver.engine == EngineChoice::split;
    if (closed_form && !has_closed_form(contact)) {
        return fmt::format(
            "solver.engine = \"{}\" has no law \"{}\"; its closed form is that of a linear contact; "
            "use \"auto\", \"cvode\" or \"arkode\"",
            name(solver.engine), name(law_of(contact)));
    }
    if (hammer.cubic_stiffness_n_per_m3 == 0 || solver.engine != EngineChoice::exact) return {};
    return fmt::format(
        "solver.engine = \"exact\" has no cubic spring, and hammer.cubic_stiffness_n_per_m3 = {}; its closed "
        "form is that of a linear one; use \"auto\", which leaves the term out where that is safe, or set the "
        "stiffness to 0",
        toml_text(hammer.cubic_stiffness_n_per_m3));
}

std::string rule_of_rigid_stop(const Contact& contact, std::string_view start_name, double start,
                               std::string_view gap_name, double gap) {
    if (!is_rigid(contact) || start <= gap) return {};
    return fmt::format(
        "{} = {} lies beyond a rigid stop at {} = {}; no hammer is there; start it at {} or less, or take the "
        "stop further away",
        start_name, toml_text(start), gap_name, toml_text(gap), toml_text(gap));
}

std::string reason_for_other_law(ContactLaw law) {
    return fmt::format(
        "belongs to law = \"{}\"; the stop of this job has another law, to which it means nothing; "
        "remove it",
        name(law));
}

std::string rule_of_gaps(const Sweep& sweep) {
    std::vector<double> gaps = sweep.gaps();
    std::ranges::sort(gaps);
    const auto twice = std::ranges::adjacent_find(gaps);
    if (twice == gaps.end()) return {};
    return fmt::format("sweep.{} has {} twice; both branches would be the same; remove one of them",
                       sweep.gap_key(), toml_text(*twice));
}

// A rank keeps a branch in memory until it is complete; with [starts], all branches of a gap and the motions on
// all attractors of each point.
std::string rule_of_samples(const Job& job) {
    constexpr std::int64_t most = 16'000'000;   // half a gigabyte per copy
    constexpr std::int64_t least_samples = 16;  // what a point takes without samples
    const bool share_a_point = job.starts.count > 0 || job.uncertainty.rigs > 0;
    const std::int64_t motions = (share_a_point ? branches_of_a_gap(job.sweep) : 1) +
                                 (job.starts.count > 0 ? job.starts.attractors + 1 : 0);
    const std::int64_t samples = std::max(job.sweep.samples, least_samples) * motions;
    if (job.columns.points <= most / samples) return {};
    const std::string of_what =
        motions == 1 ? "each" : fmt::format("of each of {} motions, those on all attractors", motions);
    return fmt::format(
        "a branch has {} points with up to {} samples {}; a rank keeps a branch in memory until it is whole, "
        "so their product is at most {}, where each point counts as {} samples at least; give fewer "
        "points{} or sweep.samples",
        job.columns.points, job.sweep.samples, of_what, most, least_samples,
        motions == 1 ? "" : ", starts.attractors");
}

std::string rule_of_interval(std::string_view name, const std::vector<double>& interval) {
    if (interval.size() != 2) {
        return fmt::format(
            "starts.{} has {}; it says from where to where starts lie; give two values, [from, to]", name,
            interval.size() == 1 ? "one value" : fmt::format("{} values", interval.size()));
    }
    if (interval[0] < interval[1]) return {};
    const bool is_empty = interval[0] == interval[1];
    return fmt::format("starts.{} runs from {} to {}; starts need {}; {}", name, toml_text(interval[0]),
                       toml_text(interval[1]), is_empty ? "some room" : "a rectangle that isn't upside down",
                       is_empty ? "give a larger second value" : "swap both values");
}

std::string rule_of_kick(const Job& job) {
    if (!job.output.has(OptionalField::critical_kick) || job.starts.count > 0 || job.kind == Kind::map)
        return {};
    return job.kind == Kind::sweep ? "output.fields asks for critical_kick; a sweep looks for those of its "
                                     "attractors, which only one "
                                     "with [starts] has; set starts.count, or remove the field"
                                   : "output.fields asks for critical_kick, which is one of an attractor; the "
                                     "cells of a basin share "
                                     "theirs; take a map of this operating point, or remove the field";
}

std::string rule_of_noise(const Noise& noise) {
    if (noise.any()) return {};
    return "[noise] has nothing that disturbs; without it settled motions last for ever; set "
           "noise.acceleration_m_s2_per_sqrt_hz, "
           "noise.amplitude_relative or noise.frequency_relative, or remove this table";
}

std::string rule_of_proved_starts(const Job& job) {
    if (!job.certificate.many_digits || job.certificate.starts) return {};
    return "certificate.many_digits = true, and no start is followed; its digits are for the way from a start; "
           "set certificate.starts = true, or remove this key";
}

std::string rule_of_proved_attractors(const Job& job) {
    if (!job.certificate.attractors) return {};
    if (job.kind != Kind::map) {
        return fmt::format(
            "certificate.attractors = true, and this is a {}; only attractors that the [starts] of a map find "
            "are "
            "certified; take a map of the same rig, or remove this key",
            name(job.kind));
    }
    if (job.starts.count == 0) {
        return "certificate.attractors = true, and this map has no cells with many starts; attractors are "
               "found by "
               "the [starts] of a map; set starts.count, or remove this key";
    }
    if (job.certificate.cells > 0) return {};
    return "certificate.attractors = true, and certificate.cells = 0; no cell is tried, and so none of its "
           "attractors; set certificate.cells, such as \"all\", or remove this key";
}

std::string rule_of_elasticities(const Job& job) {
    for (const cell::Quantity& quantity : cell::quantities) {
        const cell::StorageRule& keeping = quantity.keeping;
        if (keeping.by_number == nullptr) continue;
        const bool of_all = job.output.has(*keeping.field_of_all);
        if (!of_all && !job.output.has(*keeping.field)) continue;
        const std::string asked =
            fmt::format("output.fields asks for {}", of_all ? keeping.name_of_all : quantity.name);
        if (law_of(job.contact) == ContactLaw::hunt_crossley) {
            return fmt::format(
                "{}, and contact.law is \"hunt_crossley\"; elasticities are derivatives of motions in closed "
                "form "
                "or by power series, which a force like delta^n does not have; remove the field, or compare "
                "two maps",
                asked);
        }
        const bool of_force = keeping.field_of_all == OptionalField::force_elasticity;
        if (of_force == is_rigid(job.contact)) {
            return of_force ? asked +
                                  ", and a rigid stop has no peak force; its largest impact speed takes the "
                                  "place; ask for speed_elasticity"
                            : asked +
                                  ", which is one of rigid stops; the peak force of this stop has one; ask for "
                                  "force_elasticity";
        }
        if (job.kind == Kind::basin) {
            return asked +
                   ", which is one of an attractor; the cells of a basin share theirs; take a map of this "
                   "operating point, or remove the field";
        }
    }
    return {};
}

std::string rule_of_cells(const Study& study) {
    const std::size_t frequencies = study.frequencies().size();
    const std::size_t gaps = study.gaps().size();
    if (frequencies == gaps) return {};
    return fmt::format(
        "study.{} has {} values and study.{} has {}; together they name cells, one pair each; give both lists "
        "with the same length",
        study.frequency_key(), frequencies, study.gap_key(), gaps);
}

std::string rule_of_study(const Contact& contact) {
    if (law_of(contact) == ContactLaw::kelvin_voigt) return {};
    return "a study needs contact.law = \"kelvin_voigt\"; it compares ways to follow a spring and a dashpot, "
           "and brings other stops along where it needs them; give the stop's stiffness and damping";
}

std::string rule_of_trace(const Job& job) {
    constexpr double most_samples = 5e6;
    constexpr double lowest_frequency = 1e-2;
    const Trace& trace = job.trace;
    const std::optional<double>& hertz = job.operating_point.frequency_hz;
    if (hertz && !has_rig(job)) return {};  // its ratio isn't known
    const double eta = job.operating_point.frequency_ratio;
    const std::string_view key = hertz ? "frequency_hz" : "frequency_ratio";
    if (eta > 0 && eta < lowest_frequency) {
        const double lowest = hertz ? lowest_frequency * natural_frequency_hz(job.hammer) : lowest_frequency;
        return fmt::format(
            "operating_point.{} = {} is too low; a cycle may last at most a hundred times the "
            "hammer's own; give {} or more, or 0 for a cart at rest",
            key, toml_text(hertz.value_or(eta)), toml_text(lowest));
    }
    if (eta > 0 && trace.duration_s > 0) {
        return fmt::format(
            "trace.duration_s is for a cart at rest ({} = 0); a driven trace shows whole "
            "forcing cycles; give trace.cycles instead",
            key);
    }
    if (eta == 0 && trace.from == TraceBegin::steady_state) {
        return fmt::format(
            "trace.from = \"steady_state\" means nothing with {} = 0; a cart at rest drives no "
            "steady state; set it to \"start\"",
            key);
    }
    if (eta == 0 && trace.duration_s == 0) {
        return fmt::format(
            "trace.duration_s is missing; a cart at rest ({} = 0) has no forcing cycles to "
            "show; give the seconds to show",
            key);
    }
    if (eta == 0 && is_rigid(job.contact)) {
        return fmt::format(
            "{} = 0 is not for a rigid stop; impacts without a force tell nothing of the stop; "
            "use contact.law = \"kelvin_voigt\" or \"hunt_crossley\"",
            key);
    }
    if (eta == 0 && !has_rig(job)) return {};  // reported already
    const double samples = cycles_shown(job) * static_cast<double>(trace.samples_per_cycle);
    if (samples <= most_samples) return {};
    return fmt::format(
        "the trace would have {:.3g} samples; {:.0f} are the most that a picture could use; give fewer cycles, "
        "a shorter duration_s or fewer samples_per_cycle",
        samples, most_samples);
}

std::string rule_of_cell_of_map(const CellOfMap& cell, std::string_view table) {
    if (escape_untrusted(cell.map, cell.map.size()) != cell.map) {
        return fmt::format(
            "{}.map has a line break or control character; it is the name of a file, which messages show; "
            "rename that file",
            table);
    }
    if (cell.map.empty() && (cell.row >= 0 || cell.column >= 0)) {
        return fmt::format(
            "{0}.row and {0}.column name a cell of a map file; {0}.map names no file; add map = \"FILE.h5\", "
            "or remove them",
            table);
    }
    if ((cell.row >= 0) == (cell.column >= 0)) return {};
    return fmt::format(
        "{0}.row and {0}.column name a cell together; one of them is missing; give both, or neither", table);
}

std::string rule_of_title(std::string_view title) {
    constexpr std::size_t longest = 1000;  // [bytes]
    if (title.size() > longest) {
        return fmt::format("title has {} bytes; it heads every picture and has at most {}; shorten it",
                           title.size(), longest);
    }
    if (escape_untrusted(title, longest) != title)
        return "title has a line break or control character; it is one line of text; remove it";
    return {};
}

}  // namespace peterka::job
