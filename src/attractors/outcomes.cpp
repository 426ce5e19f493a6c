#include "attractors/outcomes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace peterka::attractors {

Outcomes::Outcomes(const scene::Cell& own)
    : is_rigid_(scene::is_rigid(own.oscillator.contact)), weight_n_(own.scales.weight_n) {}

double Outcomes::strength_of(const cell::CellResult& end, const scene::Scales& scales) const {
    if (end.regime == cell::Regime::no_impact) return 0;
    if (is_rigid_) return scales.in_unit_of_file(end.impact_speed, cell::Dimension::speed);
    return end.peak_force * (scales.force_n / weight_n_);
}

void Outcomes::add(const cell::CellResult& end, const scene::Scales& scales) {
    const bool has_z = end.regime == cell::Regime::periodic;
    const CellOutcome label{end.regime, has_z ? end.impacts : 0, cell::has_period(end.regime) ? end.period : 0,
                            0};
    const auto same = [&](const CellOutcome& other) {
        return std::tie(other.regime, other.impacts, other.period) ==
               std::tie(label.regime, label.impacts, label.period);
    };
    auto known = std::ranges::find_if(outcomes_, same);
    if (known == outcomes_.end()) known = outcomes_.insert(known, label);
    known->probability += 1;
    draws_ += 1;
    strengths_.push_back(strength_of(end, scales));
}

void Outcomes::tell(SolvedCell& solved) const {
    std::vector<CellOutcome> ordered = outcomes_;
    std::ranges::sort(ordered, {}, [](const CellOutcome& each) {
        return std::tuple(-each.probability, each.regime, each.period, each.impacts);
    });
    solved.cell.outcomes = static_cast<std::int32_t>(ordered.size());
    const auto kept = std::min<std::size_t>(ordered.size(), cell::kept_outcomes);
    double others = 0;
    for (std::size_t i = kept; i < ordered.size(); ++i) others += ordered[i].probability;
    solved.cell.outcome_others = others / draws_;
    ordered.resize(kept);
    for (CellOutcome& each : ordered) each.probability /= draws_;
    solved.outcomes = std::move(ordered);
    if (std::ranges::all_of(strengths_, [](double each) { return std::isnan(each); })) return;
    std::vector<double> sorted = strengths_;
    for (double& each : sorted) each = std::isnan(each) ? 0 : each;
    std::ranges::sort(sorted);
    const auto quantile = [&](std::size_t percent) { return sorted[(sorted.size() * percent + 99) / 100 - 1]; };
    solved.cell.drawn_q05 = quantile(5);
    solved.cell.drawn_q50 = quantile(50);
    solved.cell.drawn_q95 = quantile(95);
}

}  // namespace peterka::attractors
