#include "curves/border_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "curves/beside.hpp"

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

struct Border {
    double frequency = 0;  // [Hz]
    CurveKind kind = CurveKind::fold;
    std::vector<Label> labels;  // that it bounds
};

// Of the stable motions beside a point of a curve, those labels that are on one side alone. A motion that ends
// there while another one with its label begins bounds no regime.
std::vector<Label> labels_bounded_at(const Rig& rig, const Place& window, const Seed& at) {
    constexpr Place along_frequency{1, 0};
    std::vector<OrbitPoint> stable = motions_beside(rig, window, at, along_frequency).stable;
    if (at.kind == CurveKind::period_doubling) {
        const auto doubled = stable_doubled_beside(rig, window, at.point, along_frequency);
        stable.insert(stable.end(), doubled.begin(), doubled.end());
    }
    std::map<Label, std::set<bool>> sides;
    for (const OrbitPoint& motion : stable) {
        sides[{motion.orbit.period, motion.orbit.impacts()}].insert(motion.place.column >
                                                                    at.point.place.column);
    }
    std::vector<Label> bounded;
    for (const auto& [label, on] : sides) {
        if (on.size() == 1) bounded.push_back(label);
    }
    return bounded;
}

std::vector<Border> borders_at(const Rig& rig, const Place& window, const Findings& found, double gap,
                               double hertz) {
    std::vector<Border> borders;
    for (const Curve& curve : found.curves) {
        for (const Crossing& crossing : curve.crossings) {
            if (std::abs(crossing.place.row - gap) >= 1e-9) continue;
            const Seed at{curve.kind, {crossing.orbit, crossing.place}};
            borders.push_back({crossing.place.column * hertz, curve.kind, labels_bounded_at(rig, window, at)});
        }
    }
    std::ranges::sort(borders, {}, &Border::frequency);
    return borders;
}

std::string borders_of(const Label& label, const std::vector<Border>& borders) {
    std::string text;
    const Border* last = nullptr;
    for (const Border& border : borders) {
        const bool again = last != nullptr && last->kind == border.kind &&
                           border.frequency - last->frequency < 1e-9 * border.frequency;
        if (again || std::ranges::count(border.labels, label) == 0) continue;
        last = &border;
        text += fmt::format("{}{:#.9g} {}", text.empty() ? "" : ", ", border.frequency,
                            kind_of_border[static_cast<std::size_t>(border.kind)]);
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
    const Rig rig(scene.job());
    const Place low = rig.place_of({scene.job().columns.from, scene.job().rows.from});
    const Place high = rig.place_of({scene.job().columns.to, scene.job().rows.to});
    std::string text;
    for (const double gap : asked.gap_ratio) {
        const auto borders = borders_at(rig, {high.column - low.column, high.row - low.row}, found, gap, hertz);
        std::string lines;
        for (const Label& label : labels) lines += borders_of(label, borders);
        text += fmt::format(
            "Borders at gap/A0 {:.6g} ({:.4g} mm) of regimes with more than 1 % of the coarse map [Hz]\n{}",
            gap, gap * scene.scales().length_m * 1e3, lines.empty() ? "  none\n" : lines);
    }
    return text;
}

}  // namespace peterka::curves
