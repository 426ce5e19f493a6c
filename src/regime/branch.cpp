#include "regime/branch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "job/axis.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"

namespace peterka::regime {

namespace {

double blow(const CellResult& cell) {
    return std::isnan(cell.peak_force) ? cell.impact_speed : cell.peak_force;
}

// Finds jumps between neighbouring columns, whatever the direction.
class JumpSearch {
  public:
    explicit JumpSearch(const std::vector<BranchPoint>& points) : points_(points) {
        double largest = 0;
        for (const BranchPoint& point : points)
            largest = std::max(largest, std::isnan(blow(point.cell)) ? 0 : blow(point.cell));
        least_change_ = largest / 20;
    }

    // Between a column and the one after it.
    [[nodiscard]] bool jumps_after(std::int64_t column) const {
        const double change = change_after(column);
        if (!(change > least_change_)) return false;
        if (!lasts(column, -1) && !lasts(column + 1, 1) && !stands_out(column)) return false;
        return change > least_ratio(column) * std::max(slope_after(column - 1), slope_after(column + 1));
    }

    // Whether a step between motions with a period may hold a jump, though it is no steeper than the way into a
    // fold may be: they differ in kind, or it is steeper than the steps beside it.
    [[nodiscard]] bool may_jump_after(std::int64_t column) const {
        const double change = slope_after(column);
        return change > least_change_ && (!same_label(cell(column), cell(column + 1)) ||
                                          change > std::max(slope_after(column - 1), slope_after(column + 1)));
    }

  private:
    [[nodiscard]] bool has(std::int64_t column) const { return column >= 0 && column < std::ssize(points_); }
    [[nodiscard]] const CellResult& cell(std::int64_t column) const {
        return points_[static_cast<std::size_t>(column)].cell;
    }
    // 0 beyond the ends and next to a cell without a blow that is known.
    [[nodiscard]] double change_after(std::int64_t column) const {
        if (!has(column) || !has(column + 1)) return 0;
        const double change = std::abs(blow(cell(column + 1)) - blow(cell(column)));
        return std::isnan(change) ? 0 : change;
    }
    // The same, but only between motions with a period: the slope.
    [[nodiscard]] double slope_after(std::int64_t column) const {
        const bool steady = has(column) && has(column + 1) && has_period(cell(column).regime) &&
                            has_period(cell(column + 1).regime);
        return steady ? change_after(column) : 0;
    }
    // Whether a motion with a period persists from a column on, in the direction of `step`.
    [[nodiscard]] bool lasts(std::int64_t column, std::int64_t step) const {
        constexpr int points = 4;
        if (!has_period(cell(column).regime)) return false;
        for (int i = 1; i < points && has(column + i * step); ++i) {
            if (!same_label(cell(column), cell(column + i * step))) return false;
        }
        return true;
    }

    // By how much a jump exceeds the steps beside it. Where a period doubles, the blow grows as the square root
    // of the distance: in a step that begins just before, by up to 1 + sqrt(2) times as much as in the next.
    // Where neither that nor a grazing, at which impacts alone are gained or lost, leads from one motion with
    // impacts to the next, there is a fold, and the way into it is steep.
    [[nodiscard]] double least_ratio(std::int64_t column) const {
        const CellResult& from = cell(column);
        const CellResult& to = cell(column + 1);
        if (from.regime != Regime::periodic || to.regime != Regime::periodic) return 2;
        const auto doubles = [](const CellResult& a, const CellResult& b) {
            return 2 * a.period == b.period && 2 * a.impacts == b.impacts;
        };
        if (same_label(from, to) || doubles(from, to) || doubles(to, from)) return 2.5;
        return from.period == to.period ? 2 : 1;
    }

    // Whether a motion with a period begins or ends, and the change is more than twice each of the four before
    // and after it.
    [[nodiscard]] bool stands_out(std::int64_t column) const {
        constexpr int steps = 4;
        if (!has_period(cell(column).regime) && !has_period(cell(column + 1).regime)) return false;
        double beside = 0;
        for (int i = 1; i <= steps; ++i)
            beside = std::max({beside, change_after(column - i), change_after(column + i)});
        return change_after(column) > 2 * beside;
    }

    const std::vector<BranchPoint>& points_;
    double least_change_ = 0;
};

Ended ended(const scene::Cell& cell, const scene::State<double>& end) {
    return {{end[0], end[1] + cell.oscillator.frequency}, cell.oscillator.gap, cell.scales};
}

// The end state in the coordinates of another cell.
scene::State<double> start_from(const Ended& last, const scene::Cell& cell) {
    const double cart_speed = cell.oscillator.frequency;  // y'/(A0 omega) at phase 0
    const double gap = cell.oscillator.gap;
    const double length = last.scales.length_m / cell.scales.length_m;
    const double rate = last.scales.frequency_rad_per_s / cell.scales.frequency_rad_per_s;
    if (length == 1 && rate == 1 && gap == last.gap) return {last.state[0], last.state[1] - cart_speed};
    const double delta = (last.state[0] + last.gap) * length - gap;
    return {std::min(delta, std::max(last.state[0] * length, 0.0)), last.state[1] * length * rate - cart_speed};
}

// The motion on which a point ends, from that of the one before, and where it ends; nothing there without a
// proof.
CellResult follow(const scene::Scene& scene, scene::Cell& cell, std::optional<Ended>& last,
                  SteadyMotion& motion, const std::function<void()>& look) {
    if (last) cell.start = start_from(*last, cell);
    CycleBroker broker;
    const Task<CellResult> search = solve_cell(broker, scene.job(), cell, {}, &motion);
    run(search, broker, look);
    if (motion.end) last = ended(cell, *motion.end);
    return search.result();
}

// Whether more than half of the change from one point to the next comes at once: in a thousandth of the step,
// which ten halvings, each towards the larger change, leave. What begins or ends like a square root changes so
// much there only if less than 0.4 % of the step lie beyond its end. Not if a motion lies between whose period
// is that of neither end, nor doubled, as where windows of chaos follow each other.
bool jumps_within(const scene::Scene& scene, std::int64_t row, const BranchPoint& from, const BranchPoint& to,
                  std::int64_t column, const std::function<void()>& look) {
    constexpr std::int64_t parts = 1024;
    const bool down = scene.job().sweep.branch(row).direction == job::Direction::down;
    if (!from.motion.end) return false;
    job::Job job = scene.job();
    job.columns.from = job::axis_value(scene.job().columns, column);
    job.columns.to = job::axis_value(scene.job().columns, column + 1);
    job.columns.points = parts + 1;
    const scene::Scene finer(job);
    std::optional<Ended> last = ended(scene.cell(row, down ? column + 1 : column), *from.motion.end);
    double before = blow(from.cell);
    double after = blow(to.cell);
    const double whole = std::abs(after - before);
    std::int64_t begin = 0;
    for (std::int64_t size = parts / 2; size > 0; size /= 2) {
        SteadyMotion motion(1);
        std::optional<Ended> middle = last;
        scene::Cell cell = finer.cell(row, down ? parts - begin - size : begin + size);
        const CellResult there = follow(finer, cell, middle, motion, look);
        const auto is_of = [&](const CellResult& end) {
            return there.period == end.period || there.period == 2 * end.period;
        };
        if (!has_period(there.regime) || !(is_of(from.cell) || is_of(to.cell)) || !motion.end) return false;
        const double between = blow(there);
        if (std::abs(between - before) > std::abs(after - between)) {
            after = between;
        } else {
            begin += size;
            before = between;
            last = middle;
        }
    }
    return std::abs(after - before) > whole / 2;
}

}  // namespace

std::vector<std::int64_t> columns_of(const scene::Scene& scene, std::int64_t row) {
    std::vector<std::int64_t> columns;
    for (std::int64_t column = 0; column < scene.columns(); ++column) columns.push_back(column);
    if (scene.job().sweep.branch(row).direction == job::Direction::down) std::ranges::reverse(columns);
    return columns;
}

BranchPoint BranchWalk::to(std::int64_t column, const std::function<void()>& look) {
    const job::Job& job = scene_.job();
    scene::Cell cell = scene_.cell(row_, column);
    BranchPoint point{{}, SteadyMotion(static_cast<std::size_t>(job.sweep.samples)), cell.oscillator.gap};
    point.cell = follow(scene_, cell, last_, point.motion, look);
    if (job.sweep.branch(row_).direction == job::Direction::independent) last_.reset();
    return point;
}

std::vector<BranchPoint> follow_branch(const scene::Scene& scene, std::int64_t row,
                                       const std::function<void()>& look) {
    BranchWalk walk(scene, row);
    std::vector<BranchPoint> points;
    const std::vector<std::int64_t> columns = columns_of(scene, row);
    points.reserve(columns.size());
    for (const std::int64_t column : columns) points.push_back(walk.to(column, look));
    if (columns.front() > columns.back()) std::ranges::reverse(points);
    return points;
}

void mark_jumps(std::vector<BranchPoint>& points, job::Direction direction) {
    const JumpSearch search(points);
    for (std::int64_t column = 0; column + 1 < std::ssize(points); ++column) {
        const std::int64_t reached = direction == job::Direction::down ? column : column + 1;
        points[static_cast<std::size_t>(reached)].cell.jump = search.jumps_after(column);
    }
}

void mark_jumps(const scene::Scene& scene, std::int64_t row, std::vector<BranchPoint>& points,
                const std::function<void()>& look) {
    const job::Direction direction = scene.job().sweep.branch(row).direction;
    mark_jumps(points, direction);
    if (direction == job::Direction::independent) return;
    const JumpSearch search(points);
    for (std::int64_t column = 0; column + 1 < std::ssize(points); ++column) {
        BranchPoint& before = points[static_cast<std::size_t>(column)];
        BranchPoint& after = points[static_cast<std::size_t>(column + 1)];
        const bool down = direction == job::Direction::down;
        BranchPoint& reached = down ? before : after;
        if (reached.cell.jump || !search.may_jump_after(column)) continue;
        reached.cell.jump = jumps_within(scene, row, down ? after : before, reached, column, look);
    }
}

}  // namespace peterka::regime
