#include "curves/edge_distance.hpp"

#include <algorithm>
#include <cmath>

#include "curves/free_motion.hpp"
#include "curves/orbit_check.hpp"
#include "curves/reshape.hpp"
#include "curves/stroboscopic.hpp"
#include "regime/same_orbit.hpp"
#include "support/expect.hpp"

namespace peterka::curves {

namespace {

// Where a motion followed in one direction ends, and why.
struct End {
    double at = 0;  // value on the axis
    EdgeKind kind = EdgeKind::none;
};

// The nearer end; NaN if the orbit was lost there, since nothing is known of what lies beyond.
EdgeDistance nearest(double value, const std::vector<End>& ends) {
    EdgeDistance result;
    result.kind = EdgeKind::none;
    double distance = std::numeric_limits<double>::infinity();
    for (const End& end : ends) {
        if (end.kind == EdgeKind::none || std::abs(end.at - value) >= distance) continue;
        distance = std::abs(end.at - value);
        result = {end.at - value, end.kind};
    }
    if (result.kind == EdgeKind::unknown) result.change = std::numeric_limits<double>::quiet_NaN();
    return result;
}

class Line {
  public:
    Line(const CoarseMap& map, const Rig& rig, std::int64_t most_period, const LineOfCells& line)
        : map_(map),
          rig_(rig),
          most_period_(most_period),
          line_(line),
          found_(static_cast<std::size_t>(line.is_row ? map.columns() : map.rows())) {
        const PlanePoint low = map.place(0);
        const PlanePoint high = map.place(map.count() - 1);
        window_ = {high.column - low.column, high.row - low.row};
    }

    std::vector<EdgeDistance> run() {
        const std::vector<End> ends = ends_of_free_motion();
        for (std::int64_t i = 0; i < count(); ++i) {
            const Site& site = map_.site(cell(i));
            if (found(i).kind != EdgeKind::no_orbit) continue;
            if (site.regime == regime::Regime::no_impact) found(i) = nearest(value(map_.place(cell(i))), ends);
            if (site.is_periodic(most_period_)) follow_orbit_of(i);
        }
        return found_;
    }

  private:
    [[nodiscard]] std::int64_t count() const { return std::ssize(found_); }
    [[nodiscard]] EdgeDistance& found(std::int64_t i) { return found_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] std::int64_t cell(std::int64_t i) const { return cell_of(map_, line_, i); }
    [[nodiscard]] double along(const PlanePoint& place) const {
        return line_.is_row ? place.column : place.row;
    }
    [[nodiscard]] double value(const PlanePoint& place) const { return along(rig_.values_at(place)); }
    [[nodiscard]] double coordinate(std::int64_t i) const { return along(map_.place(cell(i))); }
    [[nodiscard]] bool holds(double value_of_edge) const {
        return value_of_edge >= value(map_.place(cell(0))) &&
               value_of_edge <= value(map_.place(cell(count() - 1)));
    }

    // Follows the cell's orbit both ways and gives all cells with this motion their nearer end.
    void follow_orbit_of(std::int64_t first) {
        const auto orbit = map_.orbit(cell(first), window_);
        if (!orbit) {
            found(first) = {found(first).change, EdgeKind::unknown};
            return;
        }
        std::vector<std::int64_t> members{first};
        const End up = follow_to(*orbit, first, count() - 1, members);
        const End down = follow_to(*orbit, first, 0, members);
        for (const std::int64_t i : members) found(i) = nearest(value(map_.place(cell(i))), {down, up});
    }

    End follow_to(const OrbitPoint& orbit, std::int64_t first, std::int64_t last,
                  std::vector<std::int64_t>& members) {
        if (last == first) return {value(map_.place(cell(last))), EdgeKind::none};
        std::int64_t next = first;  // the last cell passed
        const std::int64_t way = last > first ? 1 : -1;
        const auto look = [&](const OrbitPoint& here, const OrbitPoint& there, const PlanePoint& until) {
            std::vector<std::int64_t> passed;
            std::int64_t i = next;
            while (i != last && static_cast<double>(way) * (along(until) - coordinate(i + way)) >= 0) {
                i += way;
                const Passing passing = pass(here, there, i);
                if (passing == Passing::no_motion) return false;
                if (passing == Passing::of_the_cell) passed.push_back(i);
            }
            next = i;
            members.insert(members.end(), passed.begin(), passed.end());
            return true;
        };
        const FollowedOrbit followed = follow(rig_, orbit, map_.place(cell(last)), window_, look);
        if (followed.seed) {
            const double edge = value(followed.seed->point.place);
            return {edge, holds(edge) ? static_cast<EdgeKind>(followed.seed->kind) : EdgeKind::none};
        }
        return {value(followed.last), followed.reached ? EdgeKind::none : EdgeKind::unknown};
    }

    // Relation of the followed orbit to a cell that a step passes: the cell's own motion, another stable motion
    // that coexists there, or neither: the step was too long and has missed an event.
    enum class Passing : std::uint8_t { of_the_cell, of_another, no_motion };

    [[nodiscard]] Passing pass(const OrbitPoint& here, const OrbitPoint& there, std::int64_t i) const {
        const PlanePoint place = map_.place(cell(i));
        const double whole = along(there.place) - along(here.place);
        const double share = std::clamp((coordinate(i) - along(here.place)) / whole, 0.0, 1.0);
        const bool same_events = has_same_events(here.orbit, there.orbit);
        const OrbitPoint guess = same_events ? between(here, there, share) : (share < 0.5 ? here : there);
        const auto at =
            solve(rig_, guess, window_, {Condition::on_line(place, {1, 0}), Condition::on_line(place, {0, 1})});
        if (!at) return Passing::no_motion;
        if (is_motion_of(*at, map_.site(cell(i)))) return Passing::of_the_cell;
        const OrbitFault::Kind fault = find_fault(rig_, *at).kind;
        const bool lives = fault != OrbitFault::Kind::pierces && fault != OrbitFault::Kind::slow &&
                           monodromy(rig_, at->orbit, at->place, {}).is_stable();
        return lives ? Passing::of_another : Passing::no_motion;
    }

    [[nodiscard]] bool is_motion_of(const OrbitPoint& point, const Site& site) const {
        if (!site.is_periodic(most_period_) || site.period != point.orbit.period) return false;
        const double size = 1 + point.orbit.largest_speed();
        return std::ranges::any_of(stroboscopic_states(rig_, point), [&](const Stroboscopic& at) {
            return (at.state - site.orbit).lpNorm<Eigen::Infinity>() < regime::same_point * size;
        });
    }

    // Where the motion without impacts ends on the line, within the window.
    [[nodiscard]] std::vector<End> ends_of_free_motion() const {
        std::vector<End> ends;
        const PlanePoint place = map_.place(cell(0));
        const std::size_t axis = line_.is_row ? 0 : 1;
        if (job::is_frequency(rig_.key(axis)) && rig_.is_in_ratios(axis)) {
            for (const double frequency : frequencies_with_swing(rig_.at(place))) {
                const double end = value(moved({}, axis, frequency));
                if (holds(end)) ends.push_back({end, EdgeKind::grazing});
            }
            return ends;
        }
        // between cells, which may be further apart than a resonance is wide
        constexpr std::int64_t looks = 16;
        for (std::int64_t i = 0; i + 1 < count(); ++i) {
            const PlanePoint here = map_.place(cell(i));
            const PlanePoint there = map_.place(cell(i + 1));
            for (std::int64_t look = 0; look < looks; ++look) {
                const auto at = [&](std::int64_t number) {
                    return on_way(here, there, static_cast<double>(number) / looks);
                };
                const PlanePoint from = at(look);
                const PlanePoint to = at(look + 1);
                if (const auto share = share_at_end_of_free_motion(rig_, from, to))
                    ends.push_back({value(on_way(from, to, *share)), EdgeKind::grazing});
            }
        }
        return ends;
    }

    const CoarseMap& map_;
    const Rig& rig_;
    std::int64_t most_period_;
    LineOfCells line_;
    PlanePoint window_;  // its size
    std::vector<EdgeDistance> found_;
};

}  // namespace

std::int64_t cell_of(const CoarseMap& map, const LineOfCells& line, std::int64_t i) {
    PETERKA_EXPECT(i >= 0 && i < (line.is_row ? map.columns() : map.rows()));
    return line.is_row ? line.number * map.columns() + i : i * map.columns() + line.number;
}

std::vector<EdgeDistance> edge_distances(const CoarseMap& map, const Rig& rig, std::int64_t most_period,
                                         const LineOfCells& line) {
    return Line(map, rig, most_period, line).run();
}

}  // namespace peterka::curves
