#include "job/rig_draws.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "job/normal_quantile.hpp"
#include "job/schema_plane.hpp"
#include "job/sobol.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

// More tries than draws: where fewer than one in this many lies in the ranges, the spread is not meant so.
constexpr std::int64_t most_tries_per_rig = 16;

double uniform(std::int64_t point, std::int64_t points, std::size_t dimension) {
    // in the middle of its interval of length 1/points
    const auto half = static_cast<std::uint32_t>((std::int64_t{1} << 31) / points);
    return std::ldexp(static_cast<double>(sobol(static_cast<std::uint32_t>(point), dimension)) + half, -32);
}

}  // namespace

// Scaled to unit variances, since the units of the numbers differ by many orders of magnitude.
std::optional<std::vector<std::vector<double>>> cholesky_factor(
    const std::vector<std::vector<double>>& matrix) {
    const auto size = static_cast<Eigen::Index>(matrix.size());
    const auto at = [&](Eigen::Index i, Eigen::Index j) {
        return matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    Eigen::MatrixXd correlation(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) correlation(i, j) = at(i, j) / std::sqrt(at(i, i) * at(j, j));
    }
    const Eigen::LLT<Eigen::MatrixXd> decomposed(correlation);
    if (!correlation.allFinite() || decomposed.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixXd lower = decomposed.matrixL();
    std::vector<std::vector<double>> factor(matrix.size(), std::vector<double>(matrix.size()));
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) {
            factor[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                lower(i, j) * std::sqrt(at(i, i));
        }
    }
    return factor;
}

bool RigDraws::Number::is_of_place() const {
    return !is_of_rig(key);
}

double RigDraws::Number::drawn(double own, double deviation) const {
    if (way == Way::replaced) return deviation;
    return way == Way::scaled ? own * (1 + deviation) : own + deviation;
}

RigDraws::RigDraws(const Job& job) {
    const auto rigs = static_cast<std::uint64_t>(job.uncertainty.rigs);
    if (rigs == 0) return;
    add_numbers(job.uncertainty);
    if (numbers_.empty()) return;
    const auto least = static_cast<std::int64_t>(std::bit_ceil(rigs));
    for (std::int64_t points = least; points <= most_tries_per_rig * least; points *= 2) {
        draw(job, points);
        if (count() == rigs) return;
    }
}

void RigDraws::add_numbers(const Uncertainty& uncertainty) {
    const auto add = [&](std::string_view key, Way way) {
        const std::string_view name = axis_key_of(key);
        numbers_.push_back({std::string(name), way, quantity(name).range});
    };
    for (const std::string& key : uncertainty.covariance.of) add(key, Way::added);
    for (const auto& [key, spread] : uncertainty.numbers) {
        const bool is_offset = !is_of_rig(key);
        add(key, spread.relative                         ? Way::scaled
                 : spread.from.has_value() && !is_offset ? Way::replaced
                                                         : Way::added);
    }
    if (!uncertainty.covariance.of.empty()) factor_ = cholesky_factor(uncertainty.covariance.matrix).value();
}

// Takes the first draws in range of so many points.
void RigDraws::draw(const Job& job, std::int64_t points) {
    deviations_.clear();
    for (Number& number : numbers_) number.out_of_range = 0;
    const std::vector<CellNumbers> corners = numbers_at_corners(job);
    for (tried_ = 0; tried_ < points && std::ssize(deviations_) < job.uncertainty.rigs; ++tried_) {
        Deviations deviations = deviations_of(job.uncertainty, tried_, points);
        bool fits = true;
        for (const CellNumbers& corner : corners) fits = fits && is_in_range(corner, deviations);
        if (fits) deviations_.push_back(std::move(deviations));
    }
}

RigDraws::Deviations RigDraws::deviations_of(const Uncertainty& uncertainty, std::int64_t point,
                                             std::int64_t points) const {
    Deviations deviations(numbers_.size(), 0.0);
    for (std::size_t i = 0; i < factor_.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            deviations[i] += factor_[i][j] * normal_quantile(uniform(point, points, j));
    }
    std::size_t next = factor_.size();
    for (const auto& [key, spread] : uncertainty.numbers) {
        const double share = uniform(point, points, next);
        deviations[next++] = spread.from ? *spread.from + share * (spread.to.value() - *spread.from)
                                         : spread.relative.value_or(spread.standard_deviation.value_or(0)) *
                                               normal_quantile(share);
    }
    return deviations;
}

bool RigDraws::vary_the_rig() const {
    return std::ranges::any_of(numbers_, [](const Number& number) { return !number.is_of_place(); });
}

std::string_view RigDraws::most_out_of_range() const {
    const auto most = std::ranges::max_element(numbers_, {}, &Number::out_of_range);
    return most == numbers_.end() || most->out_of_range == 0 ? std::string_view() : most->key;
}

CellNumbers RigDraws::rig(const CellNumbers& own, std::size_t n) const {
    return rig(own, deviations_[n]);
}

void RigDraws::place(CellNumbers& rig, const CellNumbers& own, std::size_t n) const {
    place(rig, own, deviations_[n]);
}

CellNumbers RigDraws::rig(const CellNumbers& own, const Deviations& deviations) const {
    CellNumbers rig = own;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const Number& number = numbers_[i];
        if (number.is_of_place()) continue;
        set_number(rig, number.key, number.drawn(number_of(own, number.key), deviations[i]));
    }
    return rig;
}

void RigDraws::place(CellNumbers& rig, const CellNumbers& own, const Deviations& deviations) const {
    rig.place.frequency_hz = number_of(own, frequency_hz.name);
    rig.place.gap_m = number_of(own, gap_m.name);
    rig.start.displacement_m = as_twin(displacement_ratio.name, own.displacement_ratio(), own);
    rig.start.velocity_m_per_s = as_twin(velocity_ratio.name, own.velocity_ratio(), own);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const Number& number = numbers_[i];
        if (!number.is_of_place()) continue;
        const double offset = is_in_si(number.key) ? deviations[i] : as_twin(number.key, deviations[i], own);
        std::optional<double>& place = is_gap(number.key) ? rig.place.gap_m : rig.place.frequency_hz;
        place = *place + offset;
    }
}

bool RigDraws::is_in_range(const CellNumbers& own, const Deviations& deviations) {
    bool fits = true;
    const auto look = [&](Number& number, const Range<double>& range, double value) {
        if (range.contains(value)) return;
        ++number.out_of_range;
        fits = false;
    };
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        Number& number = numbers_[i];
        if (!number.is_of_place())
            look(number, number.range, number.drawn(number_of(own, number.key), deviations[i]));
    }
    if (!fits) return false;
    CellNumbers rig = this->rig(own, deviations);
    place(rig, own, deviations);
    const auto whose = [&](bool (*is_it)(std::string_view)) -> Number& {
        const auto offset = std::ranges::find_if(numbers_, [&](const Number& each) { return is_it(each.key); });
        return offset != numbers_.end() ? *offset : numbers_.front();
    };
    look(whose(is_frequency), frequency_ratio.range, rig.frequency_ratio());
    look(whose(is_gap), gap_ratio.range, rig.gap_ratio());
    return fits;
}

}  // namespace peterka::job
