#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "report/axis_words.hpp"
#include "report/regime_words.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using quantities::StoredCell;

const std::string next_line = "\n" + std::string(32, ' ');
// A heading on a line of its own.
std::string capital(std::string text) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return "\n" + text + "\n";
}

constexpr std::size_t most_listed = 5;  // jumps, bands and classes of a branch

class Words {
  public:
    explicit Words(const scene::Scene& scene)
        : scene_(scene),
          job_(scene.job()),
          key_(column_key(job_)),
          label_(label_in_words(key_)),
          digits_(digits_apart(job_.columns)) {}

    // Heading of the branches with the same gap; `branch` is the first of them.
    [[nodiscard]] std::string gap(std::int64_t branch) const {
        const scene::Cell first = scene_.cell(branch, 0);
        const scene::Cell last = scene_.cell(branch, job_.columns.points - 1);
        const auto metres = [](const scene::Cell& cell) { return cell.oscillator.gap * cell.scales.length_m; };
        const bool one_length = std::abs(metres(first) - metres(last)) <= 1e-12 * std::abs(metres(first));
        if (first.oscillator.gap == last.oscillator.gap && one_length)
            return capital(gap_in_words(job_, first.oscillator.gap, metres(first)));
        if (first.oscillator.gap == last.oscillator.gap)
            return capital(fmt::format("gap/A0 {:.4g}", first.oscillator.gap));
        if (one_length) return capital(fmt::format("gap {:.4g} mm", 1e3 * metres(first)));
        return fmt::format("\nAlong {}\n", key_);
    }

    [[nodiscard]] std::string branch(const BranchFindings& found) const {
        const std::string direction(job::name(found.branch.direction));
        return line(direction, is_resonance(found) ? "impact resonance" : "largest 1/1 force",
                    one_to_one(found)) +
               line("", "largest force", largest(found)) + line("", "jumps", jumps(found)) +
               line("", "bands", bands(found)) + line("", "shares", shares(found));
    }

    // The widest stretches.
    [[nodiscard]] std::string hysteresis(const BranchFindings& up, const BranchFindings& down) const {
        const std::vector<Stretch> found = find_hysteresis(up, down);
        std::vector<Stretch> widest = found;
        std::ranges::stable_sort(widest, std::ranges::greater{},
                                 [&](const Stretch& one) { return value(one.last) - value(one.first); });
        widest.resize(std::min(widest.size(), most_listed));
        std::ranges::sort(widest, {}, &Stretch::first);
        std::string text;
        for (const Stretch& stretch : widest) {
            const std::string where =
                stretch.first == stretch.last
                    ? fmt::format("{} alone", at_axis(value(stretch.first)))
                    : fmt::format("{} to {}, width {}", at_axis(value(stretch.first)),
                                  at_axis(value(stretch.last)),
                                  value_in_words(scene_, key_, value(stretch.last) - value(stretch.first)));
            text +=
                fmt::format("{}{}: {}", text.empty() ? "" : next_line, where, motions_along(up, down, stretch));
        }
        if (found.size() > widest.size())
            text += fmt::format("{}and {} narrower", next_line, found.size() - widest.size());
        return line("both", "hysteresis", text.empty() ? "none" : text);
    }

    // With the forces in the middle if both branches have the same motions: these then differ by more than one
    // percent.
    [[nodiscard]] std::string motions_along(const BranchFindings& up, const BranchFindings& down,
                                            const Stretch& stretch) const {
        const std::string above = motions(up, stretch);
        const std::string below = motions(down, stretch);
        if (above != below) return fmt::format("up {}, down {}", above, below);
        const std::int64_t middle = (stretch.first + stretch.last) / 2;
        return fmt::format("{}, at {} up {}, down {}", above, at_axis(value(middle)),
                           short_force(at(up, middle), middle, 4), short_force(at(down, middle), middle, 4));
    }

    // "2/2" or "3/2 to 4/2", where the first motion of a stretch and its last one differ.
    [[nodiscard]] static std::string motions(const BranchFindings& found, const Stretch& stretch) {
        const std::string first = name_of(motion_class(at(found, stretch.first)));
        const std::string last = name_of(motion_class(at(found, stretch.last)));
        return first == last ? first : fmt::format("{} to {}", first, last);
    }

    // What the starts of all points found, and which of that no branch visits.
    [[nodiscard]] std::string beside(const GapAttractors& found) const {
        const std::string several =
            fmt::format("{} of {} points have several attractors, {} at most", readable_count(found.several),
                        readable_count(found.points), found.most);
        return line("starts", "coexisting", several) + line("", "on no branch", unvisited(found));
    }

  private:
    [[nodiscard]] std::string unvisited(const GapAttractors& found) const {
        if (found.unvisited.empty()) return "nothing that is known";
        std::string text = fmt::format(
            "at {}:", found.with_unvisited == 1 ? "1 point" : readable_count(found.with_unvisited) + " points");
        for (std::size_t i = 0; i < std::min(found.unvisited.size(), most_listed); ++i) {
            const Unvisited& each = found.unvisited[i];
            text += fmt::format(
                "{}{} {}, {}", i == 0 ? " " : "," + next_line,
                (each.beside_its_like ? "another " : "") + name_of(each.motion),
                each.first == each.last ? over(each.first, each.last)
                                        : fmt::format("at {} points from {}", readable_count(each.points),
                                                      over(each.first, each.last)),
                each.largest_share > 0 ? fmt::format("up to {:.3g} % of the starts", 100 * each.largest_share)
                                       : "known, though no start found it");
        }
        if (found.unvisited.size() > most_listed)
            text += fmt::format(" and {} more", found.unvisited.size() - most_listed);
        return text;
    }
    static std::string line(const std::string& branch, const char* what, const std::string& text) {
        return text.empty() ? "" : fmt::format("  {:<12}{:<18}{}\n", branch, what, text);
    }
    [[nodiscard]] double value(std::int64_t column) const { return job::axis_value(job_.columns, column); }
    [[nodiscard]] std::string at_axis(double value) const {
        return value_in_words(scene_, key_, value, digits_);
    }
    // "9 Hz to 11 Hz", or "at 9 Hz" of one point.
    [[nodiscard]] std::string over(std::int64_t first, std::int64_t last) const {
        const std::string start = at_axis(value(first));
        return first == last ? "at " + start : fmt::format("{} to {}", start, at_axis(value(last)));
    }
    [[nodiscard]] std::string force(const BranchFindings& found, std::int64_t column) const {
        return force_in_words(job_, at(found, column).peak_force, weight(column));
    }
    [[nodiscard]] std::string short_force(const StoredCell& cell, std::int64_t column, int digits) const {
        return short_force_in_words(job_, cell.peak_force, weight(column), digits);
    }
    [[nodiscard]] double weight(std::int64_t column) const { return scene_.cell(0, column).scales.weight_n; }

    static bool is_resonance(const BranchFindings& found) {
        return found.one_to_one && found.around_one_to_one.inside();
    }
    [[nodiscard]] std::string one_to_one(const BranchFindings& found) const {
        if (!found.one_to_one) return "no motion with z = 1/1 has a force";
        constexpr int as_above = 6;  // where the summary tells the largest force of all
        return fmt::format("{} at {} {}, {}", force(found, *found.one_to_one), label_,
                           value_in_words(scene_, key_, value(*found.one_to_one), std::max(digits_, as_above)),
                           is_resonance(found) ? "the largest of z = 1/1" : no_maximum(found));
    }
    // Why the largest force is not a resonance. A branch enters a band from one side and leaves it at the
    // other.
    static std::string no_maximum(const BranchFindings& found) {
        const auto& [below, above] = found.around_one_to_one;
        const bool down = found.branch.direction == job::Direction::down;
        const Side before = down ? above : below;
        const bool begins = before != Side::own_band;
        const char* verb = begins ? "begins" : "ends";
        switch (begins ? before : (down ? below : above)) {
            case Side::jump:
                return fmt::format("where z = 1/1 {} with a jump: no resonance", verb);
            case Side::end_of_sweep:
                return "at the end of the sweep: it may be larger beyond";
            case Side::other_band:
            case Side::own_band:
                break;
        }
        return fmt::format("where z = 1/1 {}: no resonance", verb);
    }

    [[nodiscard]] std::string largest(const BranchFindings& found) const {
        if (!found.largest || found.largest == found.one_to_one) return "";
        const StoredCell& cell = at(found, *found.largest);
        const bool at_end = found.largest == 0 || *found.largest + 1 == std::ssize(found.cells);
        return fmt::format("{} at {} {}, {}{}", force(found, *found.largest), label_,
                           at_axis(value(*found.largest)), name_of(motion_class(cell)),
                           at_end ? ", at the end of the sweep: it may be larger beyond" : "");
    }

    // The largest jumps, in the branch's direction.
    [[nodiscard]] std::string jumps(const BranchFindings& found) const {
        std::vector<Jump> largest = found.jumps;
        const auto size = [&](const Jump& jump) {
            const double change = std::abs(blow(at(found, jump.to)) - blow(at(found, jump.from)));
            return std::isnan(change) ? 0 : change;
        };
        std::ranges::stable_sort(largest, std::ranges::greater{}, size);
        largest.resize(std::min(largest.size(), most_listed));
        const bool down = found.branch.direction == job::Direction::down;
        std::ranges::sort(largest,
                          [&](const Jump& a, const Jump& b) { return down ? a.to > b.to : a.to < b.to; });
        std::string text;
        for (const Jump& jump : largest) text += (text.empty() ? "" : next_line) + in_words(found, jump);
        if (found.jumps.size() > largest.size()) {
            text += fmt::format("{}and {} smaller ones", next_line, found.jumps.size() - largest.size());
        }
        return text.empty() ? "none" : text;
    }

    [[nodiscard]] std::string in_words(const BranchFindings& found, const Jump& jump) const {
        const StoredCell& before = at(found, jump.from);
        const StoredCell& after = at(found, jump.to);
        return fmt::format("{} from {}{} to {}{}", at_axis((value(jump.from) + value(jump.to)) / 2),
                           name_of(motion_class(before)), short_blow(before, jump.from),
                           name_of(motion_class(after)), short_blow(after, jump.to));
    }
    // " (12.3 N)"; of a rigid stop the impact speed, or nothing where it isn't stored.
    [[nodiscard]] std::string short_blow(const StoredCell& cell, std::int64_t column) const {
        if (!job::is_rigid(job_.contact)) return fmt::format(" ({})", short_force(cell, column, 3));
        if (std::isnan(cell.impact_speed)) return "";
        return fmt::format(" ({})", readable_amount(cell.impact_speed, "m/s", 3));
    }

    static const StoredCell& at(const BranchFindings& found, std::int64_t column) {
        return found.cells[static_cast<std::size_t>(column)];
    }

    // The widest bands.
    [[nodiscard]] std::string bands(const BranchFindings& found) const {
        std::vector<Band> widest = found.bands;
        std::ranges::stable_sort(widest, std::ranges::greater{}, &Band::points);
        widest.resize(std::min(widest.size(), most_listed));
        std::ranges::sort(widest, {}, &Band::first);
        std::string text;
        for (const Band& band : widest) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(band.motion),
                                over(band.first, band.last));
        }
        if (found.bands.size() > widest.size()) {
            const std::size_t others = found.bands.size() - widest.size();
            text += fmt::format(" and {} narrower {}", others, others == 1 ? "band" : "bands");
        }
        return text;
    }

    [[nodiscard]] std::string shares(const BranchFindings& found) const {
        std::string text;
        for (std::size_t i = 0; i < std::min(found.points.size(), most_listed); ++i) {
            const auto& [motion, points] = found.points[i];
            text += fmt::format("{}{} {}", i == 0 ? "" : ", ", name_of(motion),
                                readable_share(points, std::ssize(found.cells)));
        }
        if (found.points.size() > most_listed)
            text += fmt::format(" and {} more", found.points.size() - most_listed);
        return text;
    }

    const scene::Scene& scene_;
    const job::Job& job_;
    std::string_view key_;
    std::string label_;
    int digits_;
};

}  // namespace

std::string sweep_summary(const scene::Scene& scene, std::span<const BranchFindings> branches,
                          std::span<const GapAttractors> beside) {
    const Words words(scene);
    const bool both = scene.job().sweep.direction == job::Direction::both;
    std::string text;
    for (std::size_t i = 0; i < branches.size(); ++i) {
        if (!both || i % 2 == 0) text += words.gap(static_cast<std::int64_t>(i));
        text += words.branch(branches[i]);
        if (both && i % 2 == 0) continue;
        if (both) text += words.hysteresis(branches[i - 1], branches[i]);
        const std::size_t gap = both ? i / 2 : i;
        if (gap < beside.size()) text += words.beside(beside[gap]);
    }
    return text;
}

}  // namespace peterka
