// The tables of a map or sweep that draw rigs for each cell.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "job/axis_quantity.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/rules.hpp"
#include "job/rules_of_uncertainty.hpp"

namespace peterka::job {

inline constexpr std::string_view not_for_uncertain_places =
    "is for numbers of the rig; what is uncertain of the place is an offset, the same for all cells; give "
    "standard_deviation, or from and to";

template <typename Walker>
void describe(Walker& table, Spread& spread, const AxisQuantity& of) {
    constexpr auto width = from_to(smallest_magnitude, largest_magnitude, "an uncertainty has a width");
    const bool is_of_place = !is_of_rig(of.key);
    const auto offsets = from_to(-largest_magnitude, largest_magnitude, "an offset is a finite magnitude");
    if (is_of_place) {
        table.refuse("relative", not_for_uncertain_places);
    } else {
        table.optional_number({"relative", "standard deviation over the job's own value [1]"}, spread.relative,
                              from_to(smallest_magnitude, 10.0, "a share of the job's own value"));
    }
    table.optional_number({"standard_deviation", "of a normal distribution around the job's own value"},
                          spread.standard_deviation, width);
    table.optional_number({"from", is_of_place ? "smallest offset, all alike" : "smallest value, all alike"},
                          spread.from, is_of_place ? offsets : of.range);
    table.optional_number({"to", is_of_place ? "largest offset" : "largest value"}, spread.to,
                          is_of_place ? offsets : of.range);
    table.rule({"relative", "standard_deviation", "from", "to"},
               [&] { return rule_of_spread(key_in_tables(of.key), spread); });
}

template <typename Walker>
void describe(Walker& table, Covariance& covariance) {
    constexpr auto finite =
        from_to(-largest_magnitude * largest_magnitude, largest_magnitude * largest_magnitude,
                "a covariance is a finite magnitude");
    table.words({"of", "tables and keys of the numbers", "[\"contact.stiffness_n_per_m\"]"}, covariance.of);
    table.numbers({"mean", "of each, as identified, in SI units", "[5.5e6]"}, covariance.mean, finite);
    table.rows({"matrix", "their covariance in SI units, row by row", "[[2.7e10]]"}, covariance.matrix, finite);
    table.rule({"of", "mean", "matrix"}, [&] { return rule_of_covariance(covariance); });
}

// In each table, the numbers that an axis may vary.
template <typename Walker>
void describe_spreads(Walker& uncertainty, Job& job, std::string_view name) {
    uncertainty.table({name, "numbers that are uncertain, each by itself"}, [&](auto& table) {
        for (const auto* word : {"law", "cubic"}) {
            table.refuse(word, "is a word, which has no spread; only numbers are uncertain; remove this key");
        }
        for (const AxisQuantity& each : axis_quantities()) {
            const std::string key = key_in_tables(each.key);
            if (!key.starts_with(fmt::format("{}.", name))) continue;
            // this view points into the list's own text
            const std::string_view last = std::string_view(each.key).substr(each.key.find('.') + 1);
            if (each.law && *each.law != law_of(job.contact)) {
                table.refuse(last, reason_for_other_law(*each.law));
                continue;
            }
            const auto known = job.uncertainty.numbers.find(key);
            Spread spread = known == job.uncertainty.numbers.end() ? Spread{} : known->second;
            table.table({last, each.meaning}, [&](auto& inner) {
                describe(inner, spread, each);
                job.uncertainty.numbers[key] = spread;
            });
            if (!spread.is_given()) job.uncertainty.numbers.erase(key);
        }
    });
}

template <typename Walker>
void describe_uncertainty(Walker& file, Job& job) {
    // Without it the text of a job, and so its file, is what it was before there was this table.
    const std::size_t faults_before = file.count_faults();
    const bool is_given = job.uncertainty != Uncertainty{};
    file.table({.name = "uncertainty",
                .meaning = "rigs drawn for each cell around the job's own, to tell what is likely",
                .is_written = is_given},
               [&](auto& table) {
                   table.skip({"file"});  // followed before anything is read (covariance_file.hpp)
                   table.integer({"rigs", "drawn for each cell, the same in all; 0 for none"},
                                 job.uncertainty.rigs,
                                 from_to<std::int64_t>(0, 10'000, "some dozens tell what is likely"));
                   table.rule({"rigs"}, [&] { return rule_of_rigs(job.uncertainty); });
                   table.table({"covariance", "numbers that are uncertain together"},
                               [&](auto& inner) { describe(inner, job.uncertainty.covariance); });
                   for (const std::string_view name : {"hammer", "cart", "contact", "operating_point"}) {
                       describe_spreads(table, job, name);
                   }
               });
    if (file.count_faults() > faults_before) return;  // draws would only say the same again
    file.rule({"uncertainty", "hammer", "cart", "contact", "axes"}, [&] { return rule_of_uncertainty(job); });
}

}  // namespace peterka::job
