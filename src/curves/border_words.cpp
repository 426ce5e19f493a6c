#include "curves/border_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "curves/asked_gaps.hpp"
#include "curves/beside.hpp"
#include "curves/proof_words.hpp"
#include "job/axis_quantity.hpp"
#include "job/twins.hpp"

namespace peterka::curves {

namespace {

using Label = std::pair<std::int64_t, std::int64_t>;  // q, p

constexpr const char* kind_of_border[] = {"fold", "period doubling", "grazing"};

std::vector<Label> common_labels(const CurveSearchResult& found, std::int64_t most_period) {
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
    double at = 0;  // in the unit given in the heading
    CurveKind kind = CurveKind::fold;
    std::vector<Label> labels;  // of the regimes that it bounds
    std::string proof;          // in words
};

// The labels of stable motions that exist on one side of a curve only. Where a motion ends and another one with
// the same label begins, the curve bounds no regime.
std::vector<Label> labels_bounded_at(const Rig& rig, const PlanePoint& window, const Seed& at,
                                     std::size_t axis) {
    const PlanePoint along = moved({}, axis, 1);
    std::vector<OrbitPoint> stable = motions_beside(rig, window, at, along).stable;
    if (at.kind == CurveKind::period_doubling) {
        const auto doubled = stable_doubled_beside(rig, window, at.point, along);
        stable.insert(stable.end(), doubled.begin(), doubled.end());
    }
    std::map<Label, std::set<bool>> sides;
    for (const OrbitPoint& motion : stable) {
        const bool beyond = coordinate(motion.place, axis) > coordinate(at.point.place, axis);
        sides[{motion.orbit.period, motion.orbit.impacts()}].insert(beyond);
    }
    std::vector<Label> bounded;
    for (const auto& [label, on] : sides) {
        if (on.size() == 1) bounded.push_back(label);
    }
    return bounded;
}

// Borders along the axis other than the gap's.
class AlongBorders {
  public:
    explicit AlongBorders(const scene::Scene& scene)
        : job_(scene.job()),
          rig_(scene.job()),
          gap_axis_(gap_axis(scene.job())),
          key_(rig_.key(axis())),
          hertz_(scene.scales().frequency_rad_per_s / (2 * std::numbers::pi)),
          metres_(scene.scales().length_m),
          has_one_length_(gap_axis_ == 0 ? job::twin_of_columns(scene.job()).has_value()
                                         : job::twin_of_rows(scene.job()).has_value()),
          gap_is_in_si_(job::is_in_si(scene.job().curves.gap_key())) {
        const job::Job& job = scene.job();
        const PlanePoint low = rig_.place_of({job.columns.from, job.rows.from});
        const PlanePoint high = rig_.place_of({job.columns.to, job.rows.to});
        window_ = {high.column - low.column, high.row - low.row};
    }

    [[nodiscard]] std::vector<double> gaps(const job::Job& job) const { return asked_gaps(rig_, job); }

    [[nodiscard]] std::vector<Border> at(const CurveSearchResult& found, double gap) const {
        std::vector<Border> borders;
        for (const Curve& curve : found.curves) {
            for (const Crossing& crossing : curve.crossings) {
                if (std::abs(coordinate(crossing.place, gap_axis_) - gap) >= 1e-9) continue;
                const Seed seed{curve.kind, {crossing.orbit, crossing.place}};
                borders.push_back({number(crossing.place), curve.kind,
                                   labels_bounded_at(rig_, window_, seed, axis()),
                                   proof_in_words(job_, key_, crossing.proof)});
            }
        }
        std::ranges::sort(borders, {}, &Border::at);
        return borders;
    }

    [[nodiscard]] std::string heading(double gap) const {
        const std::string& of_gap = rig_.key(gap_axis_);
        const double value = coordinate(rig_.values_at(moved({}, gap_axis_, gap)), gap_axis_);
        const std::string place =
            !has_one_length_ ? (job::is_in_si(of_gap) ? fmt::format("gap {:.4g} mm", value * 1e3)
                                                      : fmt::format("gap/A0 {:.6g}", value))
            : gap_is_in_si_  ? fmt::format("gap {:.4g} mm (gap/A0 {:.6g})", gap * metres_ * 1e3, gap)
                             : fmt::format("gap/A0 {:.6g} ({:.4g} mm)", gap, gap * metres_ * 1e3);
        const std::string unit =
            job::is_frequency(key_) ? "Hz" : fmt::format("{} in {}", key_, job::quantity(key_).units);
        return fmt::format("Borders at {} of regimes with more than 1 % of the coarse map [{}]\n", place, unit);
    }

  private:
    [[nodiscard]] std::size_t axis() const { return 1 - gap_axis_; }
    [[nodiscard]] double number(const PlanePoint& place) const {
        return job::is_frequency(key_) ? coordinate(place, axis()) * hertz_
                                       : coordinate(rig_.values_at(place), axis());
    }

    const job::Job& job_;
    Rig rig_;
    std::size_t gap_axis_;
    std::string key_;  // of that axis
    double hertz_;     // at Omega/omega = 1
    double metres_;
    bool has_one_length_;  // A0 is the same in all cells
    bool gap_is_in_si_;    // in the job's list
    PlanePoint window_;
};

std::string borders_of(const Label& label, const std::vector<Border>& borders, bool with_proofs) {
    const char* separator = with_proofs ? ",\n             " : ", ";
    std::string text;
    const Border* last = nullptr;
    for (const Border& border : borders) {
        const bool again =
            last != nullptr && last->kind == border.kind && border.at - last->at < 1e-9 * std::abs(border.at);
        if (again || std::ranges::count(border.labels, label) == 0) continue;
        last = &border;
        text += fmt::format("{}{:#.9g} {}{}", text.empty() ? "" : separator, border.at,
                            kind_of_border[static_cast<std::size_t>(border.kind)], border.proof);
    }
    if (text.empty()) return "";
    const auto [period, impacts] = label;
    const std::string name = impacts == 0 ? "no impact" : fmt::format("{}/{}", impacts, period);
    return fmt::format("  {:<11}{}\n", name, text);
}

}  // namespace

std::string borders_in_words(const scene::Scene& scene, const CurveSearchResult& found) {
    const job::Job& job = scene.job();
    if (job.curves.gaps().empty()) return "";
    const std::vector<Label> labels = common_labels(found, job.curves.max_period);
    const AlongBorders along(scene);
    std::string text;
    for (const double gap : along.gaps(job)) {
        const auto borders = along.at(found, gap);
        std::string lines;
        for (const Label& label : labels) lines += borders_of(label, borders, job.certificate.cells > 0);
        text += along.heading(gap) + (lines.empty() ? "  none\n" : lines);
    }
    return text + proofs_in_words(scene, found);
}

}  // namespace peterka::curves
