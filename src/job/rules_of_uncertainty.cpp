#include "job/rules_of_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/meant.hpp"
#include "job/rig_draws.hpp"
#include "job/rules.hpp"
#include "job/settle.hpp"
#include "job/sobol.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {
namespace {

constexpr std::int64_t fewest_rigs = 20;

std::string row_of_other_length(const Covariance& covariance) {
    const std::size_t size = covariance.of.size();
    for (const std::vector<double>& row : covariance.matrix) {
        if (row.size() == size) continue;
        return fmt::format(
            "uncertainty.covariance.matrix has a row of {} {}; of names {}; give each row as many", row.size(),
            row.size() == 1 ? "number" : "numbers", size);
    }
    return "";
}

bool is_symmetric(const std::vector<std::vector<double>>& matrix) {
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double size = std::sqrt(std::abs(matrix[i][i] * matrix[j][j]));
            if (!(std::abs(matrix[i][j] - matrix[j][i]) <= rounding * size)) return false;
        }
    }
    return true;
}

std::vector<std::string> all_numbers(const Uncertainty& uncertainty) {
    std::vector<std::string> keys = uncertainty.covariance.of;
    for (const auto& [key, spread] : uncertainty.numbers) keys.push_back(key);
    return keys;
}

// A name that a covariance gives, for a stop with this law.
std::string rule_of_name(const std::string& name, ContactLaw law) {
    const std::vector<std::string> keys = uncertain_keys(law);
    if (std::ranges::find(keys, name) != keys.end()) return "";
    const std::string what = fmt::format("uncertainty.covariance.of names {}", toml_text(name));
    const AxisQuantity* other = find_quantity(name);
    if (other != nullptr && other->law && *other->law != law)
        return fmt::format("{}, which {}", what, reason_for_other_law(*other->law));
    const Meant meant = meant_by(name, {keys.begin(), keys.end()});
    return fmt::format("{}; no number of a rig or of its place has that name; {}", what,
                       meant.found() ? meant.question() : fmt::format("choose from {}", fmt::join(keys, ", ")));
}

std::string rule_of_twice(const std::vector<std::string>& keys) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!says_the_same(axis_key_of(keys[i]), axis_key_of(keys[j]))) continue;
            return fmt::format(
                "[uncertainty] has {} and {}; a number is uncertain in one way; remove one of them", keys[j],
                keys[i]);
        }
    }
    return "";
}

// Of the job's own value, or of an axis.
std::string rule_of_own_value(const Job& job, const std::string& key, const Spread& spread) {
    const std::string_view name = axis_key_of(key);
    const bool is_on_axis =
        has_axis(job, is_of_rig) && (says_the_same(name, column_key(job)) ||
                                     (job.kind != Kind::sweep && says_the_same(name, row_key(job))));
    if (spread.from && is_of_rig(name) && is_on_axis) {
        return fmt::format(
            "uncertainty.{} has from and to, and an axis varies it; every cell would have the same values; "
            "give "
            "relative or standard_deviation, around the cell's own",
            key);
    }
    const auto is_zero = [&](const CellNumbers& cell) { return number_of(cell, name) == 0; };
    if (!spread.relative || !std::ranges::any_of(numbers_at_corners(job), is_zero)) return "";
    return fmt::format(
        "uncertainty.{0}.relative is a share of 0, since {0} = 0 there; that spreads nothing; give "
        "standard_deviation",
        key);
}

// Each name by itself, and all together.
std::string rule_of_names(const Job& job) {
    const Uncertainty& uncertainty = job.uncertainty;
    for (const std::string& name : uncertainty.covariance.of) {
        if (std::string text = rule_of_name(name, law_of(job.contact)); !text.empty()) return text;
    }
    const std::vector<std::string> keys = all_numbers(uncertainty);
    if (std::string text = rule_of_twice(keys); !text.empty()) return text;
    if (keys.size() > sobol_dimensions) {
        return fmt::format("[uncertainty] has {} numbers; draws have {} at most; remove some", keys.size(),
                           sobol_dimensions);
    }
    for (const auto& [key, spread] : uncertainty.numbers) {
        if (std::string text = rule_of_own_value(job, key, spread); !text.empty()) return text;
    }
    return "";
}

std::string rule_of_draws(const Job& job) {
    const RigDraws draws(job);
    if (static_cast<std::int64_t>(draws.count()) == job.uncertainty.rigs) return "";
    const std::string key = key_in_tables(draws.most_out_of_range());
    return fmt::format(
        "of {} rigs drawn only {} lie in the ranges of their keys in all cells, most often because of {}; a "
        "draw "
        "outside is drawn again, and too many would be; give it a narrower spread",
        draws.tried(), draws.count(), key);
}

bool is_sound(const Uncertainty& uncertainty) {
    const bool spreads = std::ranges::all_of(uncertainty.numbers, [](const auto& number) {
        return rule_of_spread(number.first, number.second).empty();
    });
    return spreads && rule_of_covariance(uncertainty.covariance).empty();
}

}  // namespace

std::vector<std::string> uncertain_keys(ContactLaw law) {
    std::vector<std::string> keys;
    for (const std::string_view key : axis_keys(law)) {
        if (is_of_rig(key) || is_frequency(key) || is_gap(key)) keys.push_back(key_in_tables(key));
    }
    return keys;
}

std::string rule_of_spread(std::string_view name, const Spread& spread) {
    const bool is_interval = spread.from || spread.to;
    const int ways = (spread.relative ? 1 : 0) + (spread.standard_deviation ? 1 : 0) + (is_interval ? 1 : 0);
    if (ways != 1) {
        return fmt::format(
            "uncertainty.{} says {}; it has one spread; give exactly one of relative, standard_deviation, and "
            "from "
            "with to",
            name, ways == 0 ? "nothing of how uncertain it is" : "in several ways how uncertain it is");
    }
    if (is_interval && !(spread.from && spread.to)) {
        return fmt::format("uncertainty.{} has {} alone; values are drawn between two; add {}", name,
                           spread.from ? "from" : "to", spread.from ? "to" : "from");
    }
    if (!is_interval || *spread.from < *spread.to) return "";
    const bool is_empty = *spread.from == *spread.to;
    return fmt::format("uncertainty.{} is drawn from {} to {}; {}", name, toml_text(*spread.from),
                       toml_text(*spread.to),
                       is_empty ? "that leaves nothing uncertain; give a larger to, or remove it"
                                : "the smaller one comes first; swap them");
}

std::string rule_of_covariance(const Covariance& covariance) {
    const std::size_t size = covariance.of.size();
    if (covariance.mean.size() != size || covariance.matrix.size() != size) {
        return fmt::format(
            "uncertainty.covariance has {} names in of, {} numbers in mean and {} rows in matrix; they belong "
            "to the "
            "same numbers; give as many of each",
            size, covariance.mean.size(), covariance.matrix.size());
    }
    if (std::string text = row_of_other_length(covariance); !text.empty()) return text;
    if (!is_symmetric(covariance.matrix)) {
        return "uncertainty.covariance.matrix is not symmetric; the covariance of two numbers is one number; "
               "give it "
               "twice alike";
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (covariance.matrix[i][i] > 0) continue;
        return fmt::format(
            "uncertainty.covariance.matrix gives {} a variance of {}; an uncertain number has a positive one; "
            "remove "
            "that number from of, mean and matrix",
            covariance.of[i], toml_text(covariance.matrix[i][i]));
    }
    if (size == 0 || cholesky_factor(covariance.matrix)) return "";
    return "uncertainty.covariance.matrix is not positive definite; no numbers vary together like that; check "
           "its signs "
           "and units, or remove a number that follows from the others";
}

std::string rule_of_rigs(const Uncertainty& uncertainty) {
    if (uncertainty.rigs == 0 || uncertainty.rigs >= fewest_rigs) return "";
    return fmt::format(
        "uncertainty.rigs = {} is too few; the 5 % quantile of fewer than {} is their smallest; give {} or "
        "more, or 0 "
        "for none",
        uncertainty.rigs, fewest_rigs, fewest_rigs);
}

std::string rule_of_uncertainty(const Job& job) {
    const Uncertainty& uncertainty = job.uncertainty;
    const bool has_cells =
        job.columns.points > 0 && (job.kind == Kind::sweep || job.rows.points > 0) && has_rig(job);
    if (!has_cells || !is_sound(uncertainty)) return "";  // reported already
    if (std::string text = rule_of_names(job); !text.empty()) return text;
    if (uncertainty.rigs < fewest_rigs) return "";
    if (!all_numbers(uncertainty).empty()) return rule_of_draws(job);
    return fmt::format(
        "uncertainty.rigs = {}, and nothing is uncertain; all of them would be the job's own rig; name "
        "numbers, such as "
        "[uncertainty.contact] stiffness_n_per_m = {{ relative = 0.03 }}, or a file of them",
        uncertainty.rigs);
}

}  // namespace peterka::job
