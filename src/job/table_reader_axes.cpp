// Which numbers the axes of a file vary.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/axis_quantity.hpp"
#include "job/meant.hpp"
#include "job/misspelt_tables.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"
#include "job/table_reader.hpp"

namespace peterka::job {
namespace {

struct Given {
    std::string key;  // "gap_ratio", "contact.damping_ns_per_m"
    Location where;
    bool is_table = false;
};

bool holds_tables_alone(const Table& table) {
    return !table.entries.empty() && std::ranges::all_of(table.entries, [](const Entry& entry) {
        return entry.value.as<Table>() != nullptr;
    });
}

// In the order of the file.
std::vector<Given> given_axes(const Table& axes) {
    std::vector<Given> given;
    const auto add = [&](std::string key, const Value& value) {
        given.push_back({std::move(key), value.where, value.as<Table>() != nullptr});
    };
    for (const Entry& entry : axes.entries) {
        const auto* inner = entry.value.as<Table>();
        if (inner == nullptr || !holds_tables_alone(*inner)) {
            add(entry.name, entry.value);
            continue;
        }
        for (const Entry& each : inner->entries) add(entry.name + "." + each.name, each.value);
    }
    std::ranges::stable_sort(given, {}, &Given::where);
    return given;
}

bool is_on_the_plane(std::string_view key) {
    return is_frequency(key) || is_gap(key);
}

// What is wrong with an axis by itself, for a stop with this law; "" where nothing is.
std::string complaint(const Given& axis, Kind kind, ContactLaw law) {
    if (is_start_of_basin(axis.key)) {
        return kind == Kind::sweep
                   ? fmt::format(
                         "[axes.{0}] is an axis of a basin; a sweep starts at one place; give it under "
                         "[start], or name the axis [axes.start.{0}]",
                         axis.key)
                   : fmt::format(
                         "[axes.{0}] is an axis of a basin; a map starts every cell alike; give one value "
                         "under [start], or name the axis [axes.start.{0}]",
                         axis.key);
    }
    if (const AxisQuantity* quantity = find_quantity(axis.key)) {
        if (kind == Kind::study && !is_on_the_plane(axis.key)) {
            return fmt::format(
                "[axes.{}] is for maps, sweeps and curves; studies have the plane of frequency and gap; "
                "remove this table",
                axis.key);
        }
        const std::string_view reason = kind == Kind::curves ? why_no_curves_over(axis.key) : "";
        if (!reason.empty()) {
            return fmt::format(
                "[axes.{}] {}; {}", axis.key, reason,
                axis.key.starts_with("start.") ? "give one value under [start]" : "remove this table");
        }
        if (!quantity->law || *quantity->law == law) return "";
        return fmt::format("[axes.{}] {}", axis.key, reason_for_other_law(*quantity->law));
    }
    if (is_no_number(axis.key)) {
        return fmt::format(
            "[axes.{}] is over a key that is no number; an axis runs from one value to another; "
            "choose one of its words under [{}] instead",
            axis.key, axis.key.substr(0, axis.key.find('.')));
    }
    const auto keys = axis_keys(law);
    const Meant meant = meant_by(axis.key, keys);
    return fmt::format(
        "unknown table [axes.{}]; it would have no effect; {}", axis.key,
        meant.found() ? meant.question("[axes.", "]") : fmt::format("[axes] takes {}", fmt::join(keys, ", ")));
}

std::optional<MisspeltTable> misspelt_axis(const std::string& key, ContactLaw law) {
    if (find_quantity(key) != nullptr) return std::nullopt;
    const Meant meant = meant_by(key, axis_keys(law));
    if (!meant.found() || !is_misspelt(key, meant.key)) return std::nullopt;
    return MisspeltTable{"axes." + key, fmt::format("axes.{}", meant.key)};
}

// Empty for the usual quantity in its usual place.
std::string name_of_its_own(std::string_view key, std::string_view usual) {
    return key == usual ? "" : std::string(key);
}

std::string has_in_words(Kind kind) {
    return kind == Kind::curves ? "curves have" : fmt::format("a {} has", name(kind));
}

}  // namespace

void TableReader::leave_to_axes(const Job&) {
    const Value* axes = table_.find("axes");
    if (axes == nullptr || axes->as<Table>() == nullptr) return;
    for (const Given& axis : given_axes(*axes->as<Table>())) {
        if (is_of_rig(axis.key) || axis.key.starts_with("start.")) left_to_axes_.push_back(axis.key);
    }
}

void TableReader::choose_axes_of_basin(Job& job) {
    const auto choose = [&](Axis& axis, std::string_view ratio, std::string_view si) {
        if (!has(si) && (has(ratio) || !leads_in_si_)) return;
        if (!has(ratio)) {
            axis.over = si;
            return;
        }
        skip({si});
        fault(si, table_.find(si)->where,
              fmt::format("[axes.{}] says the same as [axes.{}]; one follows from the other, so they can't run "
                          "apart; remove one of them",
                          si, ratio));
    };
    choose(job.columns, displacement_ratio.name, displacement_m.name);
    choose(job.rows, velocity_ratio.name, velocity_m_per_s.name);
}

ChosenAxes TableReader::choose_axes(Job& job) {
    const std::size_t wanted = job.kind == Kind::sweep ? 1 : 2;
    for (const Entry& entry : table_.entries) known_.emplace_back(entry.name);
    std::vector<Given> axes;
    bool has_faulty = false;
    for (const Given& axis : given_axes(table_)) {
        std::string text = complaint(axis, job.kind, law_of(job.contact));
        const auto same =
            std::ranges::find_if(axes, [&](const Given& other) { return says_the_same(axis.key, other.key); });
        if (text.empty() && same != axes.end()) {
            text = fmt::format(
                "[axes.{}] says the same as [axes.{}]; one follows from the other, so they can't run "
                "apart; remove one of them",
                axis.key, same->key);
        } else if (text.empty() && axes.size() == wanted) {
            text = fmt::format("[axes.{}] is one too many; {} {}; remove one of them", axis.key,
                               has_in_words(job.kind), wanted == 1 ? "one axis" : "two axes, columns and rows");
        }
        if (text.empty()) {
            axes.push_back(axis);
        } else {
            fault(axis.key, axis.where, text);
            faults_.back().misspelt = misspelt_axis(axis.key, law_of(job.contact));
            has_faulty = true;
        }
    }
    // a missing axis is no fault if a faulty one may be meant for it
    const bool are_known = !has_faulty || axes.size() == wanted;
    const ChosenAxes usual{.count = axes.empty() && has_faulty ? 0 : 2, .are_known = are_known};
    const std::string_view frequency = leads_in_si_ ? frequency_hz.name : frequency_ratio.name;
    const std::string_view gap = leads_in_si_ ? gap_m.name : gap_ratio.name;
    // what is missing is reported by these names
    job.columns.over = name_of_its_own(frequency, frequency_ratio.name);
    if (wanted == 2) job.rows.over = name_of_its_own(gap, gap_ratio.name);
    if (axes.empty()) return usual;
    if (!has_any_axes(job.kind)) {  // they are those of frequency and gap, in this order
        for (const Given& axis : axes) {
            if (is_frequency(axis.key)) job.columns.over = name_of_its_own(axis.key, frequency_ratio.name);
            if (is_gap(axis.key)) job.rows.over = name_of_its_own(axis.key, gap_ratio.name);
        }
        return usual;
    }
    // the usual ones in their usual order have no name of their own
    job.columns.over = name_of_its_own(axes[0].key, frequency_ratio.name);
    if (wanted == 1) return {.count = 1, .are_known = are_known};
    if (axes.size() == 2) {
        job.rows.over = name_of_its_own(axes[1].key, gap_ratio.name);
        return {.count = 2, .are_known = are_known};
    }
    if (!are_known) return {.count = 1, .are_known = false};
    if (is_on_the_plane(axes[0].key)) {
        if (is_gap(axes[0].key)) job.rows.over = frequency;
        return {};
    }
    fault("axes", where_,
          fmt::format("[axes] has one axis, {}; {} two, columns and rows; add another, such as "
                      "[axes.{}]",
                      axes[0].key, has_in_words(job.kind), frequency));
    return {.count = 1, .are_known = false};
}

}  // namespace peterka::job
