#include "job/doubtful_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

constexpr double wide = 0.5;  // of the job's own value: one in forty normal deviates would be beyond 0

struct OwnValues {
    double smallest = 0;
    double largest = 0;
    double size = 0;  // to which a deviation is compared
    std::string_view size_in_words = "the largest value that it has in the job";
};

OwnValues own_values(const Job& job, std::string_view key) {
    std::vector<double> values;
    for (const CellNumbers& cell : numbers_at_corners(job)) values.push_back(number_of(cell, key));
    const auto [least, most] = std::ranges::minmax(values);
    OwnValues own{.smallest = least, .largest = most, .size = std::max(std::abs(least), std::abs(most))};
    const double amplitude = is_in_si(key) ? job.cart.amplitude_m : 1;
    if (is_gap(key) && own.size < amplitude) {  // a gap may be 0, and known exactly enough
        own.size = amplitude;
        own.size_in_words = "the cart's amplitude";
    }
    return own;
}

// With its unit, where it has one.
std::string with_unit(double number, std::string_view key) {
    const std::string& units = quantity(key).units;
    return units == "1" || units.empty() ? fmt::format("{:.4g}", number)
                                         : fmt::format("{:.4g} {}", number, units);
}

void add_wide(std::string_view name, std::string_view key, double deviation, const OwnValues& own,
              std::vector<std::string>& texts) {
    if (own.size == 0 || deviation < wide * own.size) return;
    texts.push_back(fmt::format(
        "uncertainty.{} has a standard deviation of {}, {:.3g} times {}, {}: it has the unit of the key, and "
        "is no percentage",
        name, with_unit(deviation, key), deviation / own.size, own.size_in_words, with_unit(own.size, key)));
}

void add_spread(const Job& job, const std::string& name, const Spread& spread,
                std::vector<std::string>& texts) {
    if (spread.relative) {
        if (*spread.relative < wide) return;
        texts.push_back(
            fmt::format("uncertainty.{0}.relative = {1:g} is a standard deviation of {2:g} % of the job's own "
                        "value: it is a share, not a percentage, {1:g} % is {3:g}",
                        name, *spread.relative, *spread.relative * 100, *spread.relative / 100));
        return;
    }
    const std::string_view key = axis_key_of(name);
    const OwnValues own = own_values(job, key);
    if (spread.standard_deviation) return add_wide(name, key, *spread.standard_deviation, own, texts);
    if (!spread.from || !spread.to) return;
    if (!is_of_rig(key)) {                                 // offsets
        constexpr double of_uniform = 3.4641016151377544;  // width of one over its standard deviation, sqrt(12)
        return add_wide(name, key, (*spread.to - *spread.from) / of_uniform, own, texts);
    }
    if (*spread.from <= own.largest && own.smallest <= *spread.to) return;
    texts.push_back(fmt::format(
        "uncertainty.{} is drawn from {} to {}, and the job's own value is {}, which is not among them: both "
        "have the unit of the key",
        name, with_unit(*spread.from, key), with_unit(*spread.to, key), with_unit(own.largest, key)));
}

}  // namespace

void add_doubtful_spreads(const Job& job, std::vector<std::string>& texts) {
    const Uncertainty& uncertainty = job.uncertainty;
    for (const auto& [name, spread] : uncertainty.numbers) add_spread(job, name, spread, texts);
    const Covariance& covariance = uncertainty.covariance;
    for (std::size_t i = 0; i < covariance.of.size(); ++i) {
        const std::string_view key = axis_key_of(covariance.of[i]);
        add_wide(covariance.of[i], key, std::sqrt(covariance.matrix[i][i]), own_values(job, key), texts);
    }
}

}  // namespace peterka::job
