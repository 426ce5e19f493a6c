#include "curves/branch_tables.hpp"

#include <algorithm>
#include <cmath>

#include "curves/columns.hpp"
#include "job/axis_key.hpp"

namespace peterka::curves {

namespace {

constexpr const char* end_of_branch[] = {"border", "fold", "period_doubling", "grazing", "lost"};

using Points = std::vector<const BranchPoint*>;

Points points_on(const std::vector<UnstableBranch>& branches) {
    Points points;
    for (const UnstableBranch& branch : branches) {
        for (const BranchPoint& point : branch.points) points.push_back(&point);
    }
    return points;
}

// The axis of the gap, and the one along which branches are followed.
struct AxesOfBranches {
    const Rig& rig;
    AxisOfFile gap;
    AxisOfFile along;

    [[nodiscard]] double value_of_gap(const UnstableBranch& branch) const {
        return coordinate(rig.values_at(moved({}, gap.number, branch.gap)), gap.number);
    }
    [[nodiscard]] double value_along(const BranchPoint& point) const {
        return coordinate(rig.values_at(moved({}, along.number, point.along)), along.number);
    }
};

// Several values per point, padded with NaN to rows of equal length.
template <class Values>
Numbers padded(const Points& points, std::size_t length, Values&& values) {
    Numbers numbers;
    for (const BranchPoint* each : points) {
        Numbers row = values(*each);
        row.resize(length, nan);
        numbers.insert(numbers.end(), row.begin(), row.end());
    }
    return numbers;
}

// clang-format off
Columns columns_of_branches(const std::vector<UnstableBranch>& branches, const AxesOfBranches& axes) {
    Numbers first;
    double points = 0;
    for (const UnstableBranch& branch : branches) {
        first.push_back(points);
        points += static_cast<double>(branch.points.size());
    }
    Columns columns("/", "branch", std::ssize(branches));
    columns.add_counter("number of the branch of unstable orbits");
    columns.add(axes.gap.named("branch_"), numbers_of(branches, [&](const UnstableBranch& b) { return axes.value_of_gap(b); }));
    columns.add({"branch_impacts", Number::int32, -1, "1", "p of z = p/q"}, numbers_of(branches, [](const UnstableBranch& b) { return b.impacts; }));
    columns.add({"branch_period", Number::int32, -1, "1", "q of z = p/q"}, numbers_of(branches, [](const UnstableBranch& b) { return b.period; }));
    columns.add({"branch_first", Number::int64, -1, "1", "number of the branch's first point"}, first);
    columns.add({"branch_points", Number::int64, -1, "1", "points of the branch, in their order along it"}, numbers_of(branches, [](const UnstableBranch& b) { return b.points.size(); }));
    columns.add({"branch_begin", Number::int8, -128, "", "where the branch begins", end_of_branch}, numbers_of(branches, [](const UnstableBranch& b) { return static_cast<int>(b.begins); }));
    columns.add({"branch_end", Number::int8, -128, "", "where the branch ends", end_of_branch}, numbers_of(branches, [](const UnstableBranch& b) { return static_cast<int>(b.ends); }));
    return columns;
}

Columns columns_of_branch_points(const Points& points, const AxesOfBranches& axes) {
    Columns columns("/", "branch_point", std::ssize(points));
    columns.add_counter("number of the point of a branch");
    columns.add(axes.along.named("branch_"), numbers_of(points, [&](const BranchPoint* p) { return axes.value_along(*p); }));
    columns.add({"branch_multiplier", Number::float64, nan, "1", "Floquet multiplier largest in size, with the sign of its real part"}, numbers_of(points, [](const BranchPoint* p) { return p->multiplier; }));
    columns.add({"branch_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(points, [](const BranchPoint* p) { return p->force_ratio * p->peak_force; }));
    columns.add({"branch_residual", Number::float64, nan, "1", "largest error of the equations of the orbit, relative to the hammer's velocity"}, numbers_of(points, [](const BranchPoint* p) { return p->residual; }));
    return columns;
}
// clang-format on

}  // namespace

std::vector<map_file::Table> branch_tables(const Rig& rig, const AxesOfFile& of_file,
                                           const std::vector<UnstableBranch>& branches) {
    if (branches.empty()) return {};
    const bool gap_first = job::is_gap(of_file.column.key);
    const AxesOfBranches axes{rig, gap_first ? of_file.column : of_file.row,
                              gap_first ? of_file.row : of_file.column};
    const Points points = points_on(branches);
    std::size_t samples = 0;
    for (const BranchPoint* each : points) {
        samples = std::max({samples, each->at_phase_0.size(), each->impact_times.size()});
    }
    Columns of_samples("/", "branch_sample", static_cast<std::int64_t>(samples));
    of_samples.add_counter("cycle of the orbit, or its impact, in their order");
    std::vector<Table> tables;
    for (const Columns& each :
         {columns_of_branches(branches, axes), columns_of_branch_points(points, axes), of_samples}) {
        tables.insert(tables.end(), each.tables().begin(), each.tables().end());
    }
    const auto add = [&](const char* name, const char* meaning, const auto& values) {
        tables.push_back(
            {{"/",
              Variable{name, Number::float64, nan, "1", meaning},
              {{"branch_point", std::ssize(points)}, {"branch_sample", static_cast<std::int64_t>(samples)}}},
             padded(points, samples, values)});
    };
    const auto at_phase_0 = [](int coordinate, bool adds_gap) {
        return [=](const BranchPoint& each) {
            Numbers row;
            for (const State<double>& state : each.at_phase_0) {
                row.push_back(state[coordinate] + (adds_gap ? each.gap : 0));
            }
            return row;
        };
    };
    add("branch_stroboscopic_displacement", "hammer at forcing phase 0, where the cart is at 0: x/A0",
        at_phase_0(0, true));
    add("branch_stroboscopic_velocity", "its velocity relative to the cart there: (x' - y')/(A0 omega)",
        at_phase_0(1, false));
    add("branch_impact_displacement", "hammer at first touch of each impact: x/A0",
        [](const BranchPoint& each) {
            Numbers row;
            for (const double time : each.impact_times) {
                row.push_back(std::sin(each.frequency * time) + each.gap);
            }
            return row;
        });
    return tables;
}

}  // namespace peterka::curves
