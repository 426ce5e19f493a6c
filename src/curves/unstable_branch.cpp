#include "curves/unstable_branch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "curves/branch_event.hpp"
#include "curves/reshape.hpp"
#include "curves/stroboscopic.hpp"

namespace peterka::curves {

namespace {

constexpr double first_step = 1e-4;

BranchPoint branch_point(const Rig& rig, const OrbitPoint& point, std::size_t axis) {
    const CurvePoint numbers = curve_point(rig, point, CurveKind::grazing);  // the orbit's equations only
    const PlacedRig here = rig.at(point.place);
    BranchPoint result{.along = coordinate(point.place, axis),
                       .frequency = here.frequency(),
                       .gap = here.gap(),
                       .force_ratio = rig.force_ratio(point.place),
                       .multiplier = numbers.multiplier,
                       .peak_force = numbers.peak_force,
                       .residual = numbers.residual,
                       .at_phase_0 = {},
                       .impact_times = {}};
    for (const Stroboscopic& at : stroboscopic_states(rig, point)) result.at_phase_0.push_back(at.state);
    for (const Event& event : point.orbit.events) {
        if (event.kind == EventKind::touch) result.impact_times.push_back(event.time);
    }
    return result;
}

BranchEnd end_at(CurveKind kind) {
    if (kind == CurveKind::fold) return BranchEnd::fold;
    return kind == CurveKind::period_doubling ? BranchEnd::period_doubling : BranchEnd::grazing;
}

// The gap that a point of a curve was solved for, to the last bit.
double requested_gap(const Window& window, const PlanePoint& place) {
    const double at = coordinate(place, window.gap_axis);
    if (window.gaps.empty()) return at;
    return *std::ranges::min_element(window.gaps, {}, [at](double gap) { return std::abs(gap - at); });
}

// The unstable branches that begin at a point of a curve, on either side of it and at its gap, and those that
// continue them beyond grazings.
class BranchWalk {
  public:
    BranchWalk(const Rig& rig, const Window& window, const Seed& seed)
        : rig_(rig),
          window_(window),
          seed_(seed),
          axis_(1 - window.gap_axis),
          gap_(requested_gap(window, seed.point.place)),
          stepper_(rig, window.size(), {Condition::on_line(seed.point.place, moved({}, window.gap_axis, 1))}) {}

    std::vector<UnstableBranch> run() {
        if (seed_.kind == CurveKind::grazing) {
            for (const bool gains : {true, false}) begin_beyond(seed_.point, gains);
            return found_;
        }
        Stepper::Here here = stepper_.at(seed_.point);
        for (int way = 0; way < 2; ++way) {
            begin(here, seed_);
            here.tangent = -here.tangent;
        }
        return found_;
    }

  private:
    // Begins a branch where an orbit separates from a stable one, if it is unstable in this direction.
    void begin(const Stepper::Here& from, const Seed& at) {
        constexpr std::size_t most_branches = 32;
        if (found_.size() >= most_branches) return;
        stepper_.set_step(first_step);
        const auto first = stepper_.next(from, first_step);
        if (!first || !window_.holds(first->point.place)) return;
        const OrbitFault::Kind fault = find_fault(rig_, first->point).kind;
        if (fault == OrbitFault::Kind::pierces || fault == OrbitFault::Kind::slow || is_stable(first->point))
            return;
        UnstableBranch branch;
        branch.gap = gap_;
        branch.impacts = first->point.orbit.impacts();
        branch.period = first->point.orbit.period;
        branch.begins = end_at(at.kind);
        branch.points = {branch_point(rig_, at.point, axis_), branch_point(rig_, first->point, axis_)};
        const std::optional<Seed> last = go_on(*first, branch);
        found_.push_back(branch);
        if (last && last->kind == CurveKind::grazing && last->point.orbit.period == branch.period) {
            const bool gains = last->point.orbit.impacts() == branch.impacts;
            begin_beyond(last->point, gains);
        }
    }

    // Begins beyond a grazing, with one more impact or with none in place of the grazing.
    void begin_beyond(const OrbitPoint& grazing, bool gains) {
        const std::size_t event = grazing.orbit.grazing();
        if (grazing.orbit.events[event].presses) return;  // the contact continues: no impact
        const OrbitPoint beyond = beyond_grazing(rig_, grazing, gains);
        if (beyond.orbit.events.empty()) return;  // the motion without impacts, which is stable
        Stepper::Here here = stepper_.at(beyond);
        if (gains && here.tangent[Unknowns(beyond.orbit).velocity(event)] < 0) here.tangent = -here.tangent;
        const Seed at{CurveKind::grazing, grazing};
        begin(here, at);
        here.tangent = -here.tangent;
        if (!gains) begin(here, at);  // the flight stays clear of the stop on one side
    }

    [[nodiscard]] bool is_stable(const OrbitPoint& point) const {
        return monodromy(rig_, point.orbit, point.place, Side::without_impact).is_stable();
    }

    // Follows a branch; the point of a curve at which it ends, if any.
    std::optional<Seed> go_on(Stepper::Here here, UnstableBranch& branch) {
        constexpr int most_points = 2000;
        for (int count = 0; count < most_points; ++count) {
            const PlanePoint along = Stepper::along(here.tangent);
            const double share = std::abs(coordinate(along, axis_));
            const auto next = stepper_.next(here, std::min(0.1, 0.01 / std::max(share, 1e-3)));
            if (!next) return std::nullopt;
            Stepper::Here there = *next;
            const OrbitFault fault = find_fault(rig_, there.point);
            const BranchEvent event = judge(stepper_, here.point, there.point, fault);
            const bool leaves = !window_.holds(there.point.place);
            if (event.seed && (!leaves || window_.holds(event.seed->point.place))) {
                branch.points.push_back(branch_point(rig_, event.seed->point, axis_));
                branch.ends = end_at(event.seed->kind);
                return event.seed;
            }
            if (leaves) {
                end_at_border(here.point, there.point, branch);
                return std::nullopt;
            }
            if (event.lost ||
                (fault.kind == OrbitFault::Kind::pattern && !change_events(stepper_, here, there))) {
                if (stepper_.step() < 1e-6) return std::nullopt;
                stepper_.set_step(stepper_.step() / 8);
                continue;
            }
            branch.points.push_back(branch_point(rig_, there.point, axis_));
            here = there;
        }
        return std::nullopt;
    }

    void end_at_border(const OrbitPoint& here, const OrbitPoint& there, UnstableBranch& branch) {
        const double from = coordinate(here.place, axis_);
        const double to = coordinate(there.place, axis_);
        const PlanePoint corner = to > from ? window_.high : window_.low;
        if (!has_same_events(here.orbit, there.orbit)) return;
        const double share = (coordinate(corner, axis_) - from) / (to - from);
        const auto last = solve(rig_, between(here, there, share), window_.size(),
                                stepper_.conditions_and(Condition::on_line(corner, moved({}, axis_, 1))));
        if (!last) return;
        branch.points.push_back(branch_point(rig_, *last, axis_));
        branch.ends = BranchEnd::border;
    }

    const Rig& rig_;
    const Window& window_;
    Seed seed_;
    std::size_t axis_;  // along which branches are followed, at a fixed gap
    double gap_;
    Stepper stepper_;
    std::vector<UnstableBranch> found_;
};

}  // namespace

std::vector<UnstableBranch> unstable_branches(const Rig& rig, const Seed& seed, const Window& window) {
    return BranchWalk(rig, window, seed).run();
}

bool is_same_branch(const UnstableBranch& a, const UnstableBranch& b) {
    constexpr double near = 1e-7;
    constexpr double alike = 1e-3;
    if (a.gap != b.gap || a.impacts != b.impacts || a.period != b.period) return false;
    const auto is_near = [](double x, double y) {
        return std::abs(x - y) < alike * (1 + std::min(std::abs(x), std::abs(y)));
    };
    // at and beside a grazing the multiplier jumps
    const auto is_smooth = [](BranchEnd end) { return end != BranchEnd::grazing && end != BranchEnd::lost; };
    const auto meet = [&](const BranchPoint& p, BranchEnd of_p, const BranchPoint& q, BranchEnd of_q) {
        return std::abs(p.along - q.along) < near * std::max(std::abs(p.along), 1e-3) &&
               (std::isnan(p.peak_force) || is_near(p.peak_force, q.peak_force)) &&  // none on a rigid stop
               (!is_smooth(of_p) || !is_smooth(of_q) || is_near(p.multiplier, q.multiplier));
    };
    return (meet(a.points.front(), a.begins, b.points.back(), b.ends) &&
            meet(a.points.back(), a.ends, b.points.front(), b.begins)) ||
           (meet(a.points.front(), a.begins, b.points.front(), b.begins) &&
            meet(a.points.back(), a.ends, b.points.back(), b.ends));
}

}  // namespace peterka::curves
