#include "curves/tables.hpp"

#include <iterator>
#include <optional>
#include <utility>

#include "cell/labels.hpp"
#include "curves/asked_gaps.hpp"
#include "curves/axes_of_file.hpp"
#include "curves/branch_tables.hpp"
#include "curves/columns.hpp"
#include "job/axis.hpp"
#include "job/twins.hpp"
#include "map_file/layout.hpp"

namespace peterka::curves {

namespace {

constexpr const char* kind_names[] = {"fold", "period_doubling", "grazing"};
constexpr const char* special_names[] = {"fold_grazing", "flip_grazing", "double_grazing",
                                         "cusp",         "inflection",   "generalized_flip"};
constexpr const char* edge_names[] = {"fold", "period_doubling", "grazing", "none", "unknown"};
constexpr const char* label_edge_names[] = {"edge", "same_label", "other_start", "narrow", "unknown"};
constexpr const char* end_names[] = {"border", "special", "closed", "lost"};
constexpr const char* crossed_names[] = {"not_surely_crossed", "near_grazing",   "no_orbit_enclosed",
                                         "other_label",        "no_orbit_found", "other_stop",
                                         "cubic_spring",       "not_tried",      "proved"};
static_assert(std::size(crossed_names) ==
              static_cast<std::size_t>(certificate::Crossed::proved) + 1 - certificate::first_crossed);

template <class Items>
void add_places(Columns& columns, const char* prefix, const AxesOfFile& axes, const Rig& rig,
                const Items& items) {
    for (const AxisOfFile& axis : {axes.column, axes.row}) {
        columns.add(axis.named(prefix), numbers_of(items, [&](const auto& item) {
                        return coordinate(rig.values_at(item.place), axis.number);
                    }));
    }
}

Numbers forces_of_cells(const scene::Scene& scene, const CurveSearchResult& found) {
    Numbers forces;
    for (std::int64_t cell = 0; cell < std::ssize(found.sites); ++cell) {
        const scene::Scales scales = scene.cell(cell / scene.columns(), cell % scene.columns()).scales;
        forces.push_back(scales.force_ratio() * found.sites[static_cast<std::size_t>(cell)].peak_force);
    }
    return forces;
}

// The coarse map, in the form of a map file.
std::vector<Table> coarse_map(const scene::Scene& scene, const CurveSearchResult& found) {
    const job::Job& job = scene.job();
    const AxesOfFile axes(job);
    const Dimension columns{axes.column.coordinate.name, scene.columns()};
    const Dimension rows{axes.row.coordinate.name, scene.rows()};
    std::vector<Table> tables{{{"/", axes.column.coordinate, {columns}}, job::axis_values(job.columns)},
                              {{"/", axes.row.coordinate, {rows}}, job::axis_values(job.rows)}};
    const auto add_twin = [&](const Dimension& along, const std::optional<job::Twin>& twin,
                              const job::Axis& axis) {
        if (!twin) return;
        const auto value = [&](double of_axis) { return twin->value(of_axis); };
        tables.push_back(
            {{"/", map_file::coordinate_of(twin->key), {along}}, numbers_of(job::axis_values(axis), value)});
    };
    add_twin(columns, job::twin_of_columns(job), job.columns);
    add_twin(rows, job::twin_of_rows(job), job.rows);
    const auto add = [&](const Variable& variable, const Numbers& values) {
        tables.push_back({{"/", variable, {rows, columns}}, values});
    };
    add({"regime", Number::int8, regime::regime_not_computed, "",
         "regime of the steady state, in the coarse map", cell::regime_names},
        numbers_of(found.sites, [](const Site& s) { return static_cast<int>(s.regime); }));
    add({"status", Number::int8, -128, "",
         "why a cell is unresolved or failed, or what its claim leaves open, in the coarse map",
         cell::status_names},
        numbers_of(found.sites, [](const Site& s) { return static_cast<int>(s.status); }));
    add({"impacts", Number::int32, 0, "1", "p of z = p/q in the coarse map"},
        numbers_of(found.sites, [](const Site& s) { return s.impacts; }));
    add({"period", Number::int32, 0, "1", "q of z = p/q in the coarse map"},
        numbers_of(found.sites, [](const Site& s) { return s.period; }));
    add({"peak_force_ratio", Number::float64, nan, "1",
         "largest impact force over the hammer's weight, in the coarse map"},
        forces_of_cells(scene, found));
    return tables;
}

// The distance of each of its cells from the edges of its own motion.
std::vector<Table> distances(const scene::Scene& scene, const CurveSearchResult& found) {
    const AxesOfFile axes(scene.job());
    std::vector<Table> tables;
    const auto add = [&](const Variable& variable, const Numbers& values) {
        tables.push_back(
            {{"/",
              variable,
              {{axes.row.coordinate.name, scene.rows()}, {axes.column.coordinate.name, scene.columns()}}},
             values});
    };
    const auto change = [](const EdgeDistance& each) { return each.change; };
    const auto kind = [](const EdgeDistance& each) { return static_cast<int>(each.kind); };
    if (found.along_columns.empty()) return tables;
    // clang-format off
    for (const auto& [axis, found_along] : {std::pair(&axes.column, &found.along_columns), std::pair(&axes.row, &found.along_rows)}) {
        const Variable& along = axis->coordinate;
        add({name_of("edge_distance_", along), Number::float64, nan, along.units, "smallest change along this axis, with its sign, at which the cell's own motion ends or changes"}, numbers_of(*found_along, change));
        add({name_of("edge_kind_", along), Number::int8, -128, "", "what happens to the motion there", edge_names}, numbers_of(*found_along, kind));
    }
    // clang-format on
    return tables;
}

// The items of all curves, concatenated, and each item's curve number.
template <class Item>
struct Together {
    std::vector<Item> items;
    Numbers curve;

    Together(const CurveSearchResult& found, std::vector<Item> Curve::*part) {
        for (std::size_t i = 0; i < found.curves.size(); ++i) {
            const std::vector<Item>& of_curve = found.curves[i].*part;
            items.insert(items.end(), of_curve.begin(), of_curve.end());
            curve.insert(curve.end(), of_curve.size(), static_cast<double>(i));
        }
    }
};

// clang-format off
Columns columns_of_curves(const CurveSearchResult& found) {
    Numbers first;
    double points = 0;
    for (const Curve& curve : found.curves) {
        first.push_back(points);
        points += static_cast<double>(curve.points.size());
    }
    Columns curves("/", "curve", std::ssize(found.curves));
    curves.add_counter("number of the curve");
    curves.add({"curve_kind", Number::int8, -128, "", "what happens to the orbit there", kind_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.kind); }));
    curves.add({"curve_impacts", Number::int32, -1, "1", "p of z = p/q, of the orbit on the stable side"}, numbers_of(found.curves, [](const Curve& c) { return c.impacts; }));
    curves.add({"curve_period", Number::int32, -1, "1", "q of z = p/q, of the orbit on the stable side"}, numbers_of(found.curves, [](const Curve& c) { return c.period; }));
    curves.add({"curve_first", Number::int64, -1, "1", "number of the curve's first point"}, first);
    curves.add({"curve_points", Number::int64, -1, "1", "points of the curve, in their order along it"}, numbers_of(found.curves, [](const Curve& c) { return c.points.size(); }));
    curves.add({"curve_begin", Number::int8, -128, "", "why the curve has no point before its first", end_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.begins); }));
    curves.add({"curve_end", Number::int8, -128, "", "why the curve has no point after its last", end_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.ends); }));
    curves.add({"curve_edge", Number::int8, -128, "", "whether labels of the coarse map change along the curve, or why not", label_edge_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.edge); }));
    return curves;
}

Columns columns_of_points(const CurveSearchResult& found, const Rig& rig, const AxesOfFile& axes) {
    const std::vector<CurvePoint> points = Together(found, &Curve::points).items;
    Columns of_points("/", "point", std::ssize(points));
    of_points.add_counter("number of the point");
    add_places(of_points, "point_", axes, rig, points);
    of_points.add({"point_multiplier", Number::float64, nan, "1", "Floquet multiplier largest in size, with the sign of its real part; of a grazing, of the orbit without the impact; NaN where a curve ends at an impact without speed on a rigid stop"}, numbers_of(points, [](const CurvePoint& p) { return p.multiplier; }));
    of_points.add({"point_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(points, [&](const CurvePoint& p) { return rig.force_ratio(p.place) * p.peak_force; }));
    of_points.add({"point_residual", Number::float64, nan, "1", "largest error of the defining equations, relative to the hammer's velocity"}, numbers_of(points, [](const CurvePoint& p) { return p.residual; }));
    of_points.add({"point_orbit_displacement", Number::float64, nan, "1", "the orbit at forcing phase 0 of its first cycle, where the cart is at 0: x/A0"}, numbers_of(points, [&](const CurvePoint& p) { return p.at_phase_0[0] + rig.at(p.place).gap(); }));
    of_points.add({"point_orbit_velocity", Number::float64, nan, "1", "its velocity relative to the cart there: (x' - y')/(A0 omega)"}, numbers_of(points, [](const CurvePoint& p) { return p.at_phase_0[1]; }));
    of_points.add({"point_edge", Number::int8, -128, "", "whether labels of the coarse map change there, or why not", label_edge_names}, numbers_of(points, [](const CurvePoint& p) { return static_cast<int>(p.edge); }));
    return of_points;
}

Columns columns_of_specials(const CurveSearchResult& found, const Rig& rig, const AxesOfFile& axes) {
    const auto [specials, curve] = Together(found, &Curve::specials);
    Columns of_specials("/", "special", std::ssize(specials));
    of_specials.add_counter("number of the special point");
    of_specials.add({"special_kind", Number::int8, -128, "", "what meets at the point", special_names}, numbers_of(specials, [](const Special& s) { return static_cast<int>(s.kind); }));
    add_places(of_specials, "special_", axes, rig, specials);
    of_specials.add({"special_curve", Number::int32, -1, "1", "number of the curve on which it was found"}, curve);
    return of_specials;
}

Columns columns_of_crossings(const CurveSearchResult& found, const Rig& rig, const AxesOfFile& axes, const job::Job& job) {
    const auto [crossings, curve] = Together(found, &Curve::crossings);
    Columns of_crossings("/", "crossing", std::ssize(crossings));
    of_crossings.add_counter("number of the crossing");
    of_crossings.add({"crossing_curve", Number::int32, -1, "1", "number of the curve that has one of the gaps of [curves] there"}, curve);
    add_places(of_crossings, "crossing_", axes, rig, crossings);
    of_crossings.add({"crossing_multiplier", Number::float64, nan, "1", "as point_multiplier"}, numbers_of(crossings, [](const Crossing& c) { return c.multiplier; }));
    of_crossings.add({"crossing_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(crossings, [&](const Crossing& c) { return rig.force_ratio(c.place) * c.peak_force; }));
    if (job.certificate.cells == 0) return of_crossings;
    const Variable& along = (gap_axis(job) == 0 ? axes.row : axes.column).coordinate;
    of_crossings.add({"crossing_certified", Number::int8, -128, "", "whether it is proved in interval arithmetic that the orbit changes so between the two bounds, at exactly this gap, or why not (negative)", crossed_names, certificate::first_crossed}, numbers_of(crossings, [](const Crossing& c) { return static_cast<int>(c.proof.verdict); }));
    of_crossings.add({"crossing_lower", Number::float64, nan, along.units, "proved bound of the coordinate other than the gap"}, numbers_of(crossings, [](const Crossing& c) { return c.proof.at.lo; }));
    of_crossings.add({"crossing_upper", Number::float64, nan, along.units, "proved bound of the coordinate other than the gap"}, numbers_of(crossings, [](const Crossing& c) { return c.proof.at.hi; }));
    return of_crossings;
}

Columns columns_of_run(const CurveSearchResult& found) {
    Columns live("/run", "curve", std::ssize(found.curves));
    live.add_counter("number of the curve");
    live.add({"curve_seconds", Number::float64, nan, "s", "time that tracing the curve took"}, found.seconds);
    return live;
}
// clang-format on

std::vector<Table> counts_of_edges(const EdgeCount& edges) {
    std::vector<Table> tables;
    const auto scalar = [&](const char* name, const char* meaning, std::int64_t value) {
        tables.push_back(
            {{"/edges", Variable{name, Number::int64, -1, "1", meaning}, {}}, {static_cast<double>(value)}});
    };
    scalar("count", "edges of the coarse map between orbits up to the period, or one and no impact",
           edges.edges);
    scalar("on_curve", "of these, within one cell of a curve", edges.on_curve);
    scalar("basin", "of these, where the motion of one side lives on the other, too, so that the start decides",
           edges.basin);
    return tables;
}

}  // namespace

std::vector<map_file::Table> tables_of(const scene::Scene& scene, const CurveSearchResult& found) {
    const Rig rig(scene.job());
    const AxesOfFile axes(scene.job());
    std::vector<Table> tables = coarse_map(scene, found);
    const auto append = [&](const std::vector<Table>& more) {
        tables.insert(tables.end(), more.begin(), more.end());
    };
    const auto append_if_any = [&](const Columns& columns) {  // a dimension must not be empty
        if (!columns.tables().front().values.empty()) append(columns.tables());
    };
    append(distances(scene, found));
    append_if_any(columns_of_curves(found));
    append_if_any(columns_of_points(found, rig, axes));
    append_if_any(columns_of_specials(found, rig, axes));
    append_if_any(columns_of_crossings(found, rig, axes, scene.job()));
    append(branch_tables(rig, axes, found.branches));
    append(counts_of_edges(found.edges));
    append_if_any(columns_of_run(found));  // the group to which the run's data are added
    return tables;
}

}  // namespace peterka::curves
