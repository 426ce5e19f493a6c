#include "curves/branch_tables.hpp"

#include <algorithm>
#include <cmath>

#include "curves/columns.hpp"

namespace peterka::curves {

namespace {

constexpr const char* end_of_branch[] = {"border", "fold", "period_doubling", "grazing", "lost"};

// A point of a branch, and where its branch lies.
struct PointAt {
    const BranchPoint* point;
    double gap;
};

std::vector<PointAt> points_on(const std::vector<UnstableBranch>& branches) {
    std::vector<PointAt> points;
    for (const UnstableBranch& branch : branches) {
        for (const BranchPoint& point : branch.points) points.push_back({&point, branch.gap});
    }
    return points;
}

// Values of which each point has a few, in rows of one length.
template <class Values>
Numbers padded(const std::vector<PointAt>& points, std::size_t length, Values&& values) {
    Numbers numbers;
    for (const PointAt& each : points) {
        Numbers row = values(each);
        row.resize(length, nan);
        numbers.insert(numbers.end(), row.begin(), row.end());
    }
    return numbers;
}

// clang-format off
Columns columns_of_branches(const std::vector<UnstableBranch>& branches) {
    Numbers first;
    double points = 0;
    for (const UnstableBranch& branch : branches) {
        first.push_back(points);
        points += static_cast<double>(branch.points.size());
    }
    Columns columns("/", "branch", std::ssize(branches));
    columns.add_counter("number of the branch of unstable orbits");
    columns.add({"branch_gap_ratio", Number::float64, nan, "1", "gap over cart amplitude"}, numbers_of(branches, [](const UnstableBranch& b) { return b.gap; }));
    columns.add({"branch_impacts", Number::int32, -1, "1", "p of z = p/q"}, numbers_of(branches, [](const UnstableBranch& b) { return b.impacts; }));
    columns.add({"branch_period", Number::int32, -1, "1", "q of z = p/q"}, numbers_of(branches, [](const UnstableBranch& b) { return b.period; }));
    columns.add({"branch_first", Number::int64, -1, "1", "number of the branch's first point"}, first);
    columns.add({"branch_points", Number::int64, -1, "1", "points of the branch, in their order along it"}, numbers_of(branches, [](const UnstableBranch& b) { return b.points.size(); }));
    columns.add({"branch_begin", Number::int8, -128, "", "where the branch begins", end_of_branch}, numbers_of(branches, [](const UnstableBranch& b) { return static_cast<int>(b.begins); }));
    columns.add({"branch_end", Number::int8, -128, "", "where the branch ends", end_of_branch}, numbers_of(branches, [](const UnstableBranch& b) { return static_cast<int>(b.ends); }));
    return columns;
}

Columns columns_of_branch_points(const std::vector<PointAt>& points, double force) {
    Columns columns("/", "branch_point", std::ssize(points));
    columns.add_counter("number of the point of a branch");
    columns.add({"branch_frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency"}, numbers_of(points, [](const PointAt& p) { return p.point->frequency; }));
    columns.add({"branch_multiplier", Number::float64, nan, "1", "Floquet multiplier largest in size, with the sign of its real part"}, numbers_of(points, [](const PointAt& p) { return p.point->multiplier; }));
    columns.add({"branch_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(points, [&](const PointAt& p) { return force * p.point->peak_force; }));
    columns.add({"branch_residual", Number::float64, nan, "1", "largest error of the equations of the orbit, relative to the hammer's velocity"}, numbers_of(points, [](const PointAt& p) { return p.point->residual; }));
    return columns;
}
// clang-format on

}  // namespace

std::vector<map_file::Table> branch_tables(const scene::Scene& scene,
                                           const std::vector<UnstableBranch>& branches) {
    if (branches.empty()) return {};
    const std::vector<PointAt> points = points_on(branches);
    std::size_t samples = 0;
    for (const PointAt& each : points) {
        samples = std::max({samples, each.point->at_phase_0.size(), each.point->impact_times.size()});
    }
    Columns of_samples("/", "branch_sample", static_cast<std::int64_t>(samples));
    of_samples.add_counter("cycle of the orbit, or its impact, in their order");
    std::vector<Table> tables;
    for (const Columns& each : {columns_of_branches(branches),
                                columns_of_branch_points(points, scene.scales().force_ratio()), of_samples}) {
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
        return [=](const PointAt& each) {
            Numbers row;
            for (const State<double>& state : each.point->at_phase_0) {
                row.push_back(state[coordinate] + (adds_gap ? each.gap : 0));
            }
            return row;
        };
    };
    add("branch_stroboscopic_displacement", "hammer at forcing phase 0, where the cart is at 0: x/A0",
        at_phase_0(0, true));
    add("branch_stroboscopic_velocity", "its velocity relative to the cart there: (x' - y')/(A0 omega)",
        at_phase_0(1, false));
    add("branch_impact_displacement", "hammer at first touch of each impact: x/A0", [](const PointAt& each) {
        Numbers row;
        for (const double time : each.point->impact_times) {
            row.push_back(std::sin(each.point->frequency * time) + each.gap);
        }
        return row;
    });
    return tables;
}

}  // namespace peterka::curves
