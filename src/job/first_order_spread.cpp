#include "job/first_order_spread.hpp"

#include <algorithm>
#include <cmath>

#include "job/axis_key.hpp"

namespace peterka::job {
namespace {

// An uncertain number, named as axes name it.
bool is_same(std::string_view uncertain, std::string_view key) {
    return uncertain == key || (is_frequency(uncertain) && is_frequency(key)) ||
           (is_gap(uncertain) && is_gap(key));
}

double deviation_of(const Spread& spread, double value) {
    if (spread.relative) return *spread.relative;
    const double width = spread.from ? (spread.to.value() - *spread.from) / std::sqrt(12.0) : 0;
    return spread.standard_deviation.value_or(width) / std::abs(value);
}

}  // namespace

bool is_uncertain(const Job& job, std::string_view key) {
    const auto is_key = [&](std::string_view other) { return is_same(axis_key_of(other), key); };
    return job.uncertainty.rigs > 0 && (std::ranges::any_of(job.uncertainty.covariance.of, is_key) ||
                                        std::ranges::any_of(job.uncertainty.numbers, [&](const auto& number) {
                                            return is_key(number.first);
                                        }));
}

std::optional<FirstOrderSpread> first_order_spread(const Job& job, const CellNumbers& numbers,
                                                   std::span<const Elasticity> elasticities) {
    if (job.uncertainty.rigs == 0) return std::nullopt;
    FirstOrderSpread spread{0, std::vector<double>(elasticities.size(), 0.0)};
    const auto place_of = [&](std::string_view key) {
        const auto is_it = [&](const Elasticity& one) { return is_same(key, one.key); };
        return static_cast<std::size_t>(std::ranges::find_if(elasticities, is_it) - elasticities.begin());
    };
    const Covariance& covariance = job.uncertainty.covariance;
    std::vector<std::size_t> places;
    std::vector<double> slopes;  // of the result's logarithm by each number
    const auto take = [&](std::string_view key_in_tables) {
        const std::string_view key = axis_key_of(key_in_tables);
        const double value = number_of(numbers, key);
        places.push_back(place_of(key));
        if (places.back() == elasticities.size() || value == 0) return false;
        slopes.push_back(elasticities[places.back()].value / value);
        return true;
    };
    for (const std::string& key : covariance.of) {
        if (!take(key)) return std::nullopt;
    }
    double variance = 0;
    const auto add = [&](std::size_t place, double share) {
        variance += share;
        spread.shares[place] += share;
    };
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        for (std::size_t j = 0; j < slopes.size(); ++j)
            add(places[i], slopes[i] * covariance.matrix[i][j] * slopes[j]);
    }
    for (const auto& [key, of_number] : job.uncertainty.numbers) {
        if (!take(key)) return std::nullopt;
        const std::size_t place = places.back();
        const double value = number_of(numbers, axis_key_of(key));
        const double part = elasticities[place].value * deviation_of(of_number, value);
        add(place, part * part);
    }
    if (!(variance > 0)) return std::nullopt;
    for (double& share : spread.shares) share /= variance;
    spread.deviation = std::sqrt(variance);
    return spread;
}

}  // namespace peterka::job
