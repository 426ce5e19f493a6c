#include "curves/border_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace peterka::curves {

namespace {

using Label = std::pair<std::int64_t, std::int64_t>;  // q, p

constexpr const char* kind_of_border[] = {"fold", "period doubling", "grazing"};

std::vector<Label> common_labels(const Findings& found, std::int64_t most_period) {
    std::map<Label, std::int64_t> cells;
    for (const Site& site : found.sites) {
        if (site.is_periodic(most_period)) ++cells[{site.period, site.impacts}];
        if (site.regime == regime::Regime::no_impact) ++cells[{1, 0}];
    }
    std::vector<Label> labels;
    for (const auto& [label, count] : cells) {
        if (100 * count > std::ssize(found.sites)) labels.push_back(label);
    }
    return labels;
}

// Where this motion ends, changes its stability, or gains or loses an impact; and where it is born by a
// doubling.
bool bounds(const Curve& curve, const Label& label) {
    const auto [period, impacts] = label;
    if (curve.kind == CurveKind::period_doubling && 2 * curve.period == period && 2 * curve.impacts == impacts)
        return true;
    if (curve.period != period) return false;
    const std::int64_t more = impacts - curve.impacts;
    return more == 0 || (curve.kind == CurveKind::grazing && more == 1);
}

std::string borders_of(const Label& label, const Findings& found, double gap, double hertz) {
    std::vector<std::pair<double, CurveKind>> borders;
    for (const Curve& curve : found.curves) {
        if (!bounds(curve, label)) continue;
        for (const Crossing& crossing : curve.crossings) {
            if (std::abs(crossing.place.row - gap) < 1e-9)
                borders.emplace_back(crossing.place.column * hertz, curve.kind);
        }
    }
    std::ranges::sort(borders);
    const auto meet = [](const auto& a, const auto& b) {
        return a.second == b.second && std::abs(a.first - b.first) < 1e-9 * a.first;
    };
    borders.erase(std::unique(borders.begin(), borders.end(), meet), borders.end());
    std::string text;
    for (const auto& [frequency, kind] : borders) {
        text += fmt::format("{}{:#.9g} {}", text.empty() ? "" : ", ", frequency,
                            kind_of_border[static_cast<std::size_t>(kind)]);
    }
    if (text.empty()) return "";
    const auto [period, impacts] = label;
    const std::string name = impacts == 0 ? "no impact" : fmt::format("{}/{}", impacts, period);
    return fmt::format("  {:<11}{}\n", name, text);
}

}  // namespace

std::string borders_in_words(const scene::Scene& scene, const Findings& found) {
    const job::Curves& asked = scene.job().curves;
    const double hertz = scene.scales().frequency_rad_per_s / (2 * std::numbers::pi);
    const std::vector<Label> labels = common_labels(found, asked.max_period);
    std::string text;
    for (const double gap : asked.gap_ratio) {
        std::string lines;
        for (const Label& label : labels) lines += borders_of(label, found, gap, hertz);
        text += fmt::format(
            "Borders at gap/A0 {:.6g} ({:.4g} mm) of regimes with more than 1 % of the coarse map [Hz]\n{}",
            gap, gap * scene.scales().length_m * 1e3, lines.empty() ? "  none\n" : lines);
    }
    return text;
}

}  // namespace peterka::curves
