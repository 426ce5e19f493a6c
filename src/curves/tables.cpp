#include "curves/tables.hpp"

#include <limits>

#include "cell/labels.hpp"

namespace peterka::curves {

namespace {

using hdf5::Number;
using hdf5::Variable;
using map_file::Dimension;
using map_file::Table;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kind_names[] = {"fold", "period_doubling", "grazing"};
constexpr const char* special_names[] = {"fold_grazing", "flip_grazing", "double_grazing", "cusp",
                                         "inflection"};
constexpr const char* end_names[] = {"border", "special", "closed", "lost"};

// Columns that are filled row by row.
class Columns {
  public:
    Columns(const char* group, const char* dimension, std::int64_t size)
        : group_(group), name_(dimension), dimension_{dimension, size} {}

    void add(const Variable& variable, const Numbers& values) {
        tables_.push_back({{group_, variable, {dimension_}}, values});
    }
    void add_counter(const char* meaning) {
        Numbers counts;
        for (std::int64_t i = 0; i < dimension_.size; ++i) counts.push_back(static_cast<double>(i));
        add({name_, Number::int64, -1, "1", meaning}, counts);
    }
    [[nodiscard]] const std::vector<Table>& tables() const { return tables_; }

  private:
    const char* group_;
    const char* name_;  // of the dimension; a table keeps no copy of it
    Dimension dimension_;
    std::vector<Table> tables_;
};

template <class Items, class Value>
Numbers numbers_of(const Items& items, Value&& value) {
    Numbers numbers;
    for (const auto& item : items) numbers.push_back(static_cast<double>(value(item)));
    return numbers;
}

// The coarse map, as the file of a map has it.
std::vector<Table> coarse_map(const scene::Scene& scene, const Findings& found) {
    const Dimension columns{"frequency_ratio", scene.columns()};
    const Dimension rows{"gap_ratio", scene.rows()};
    Numbers frequencies;
    Numbers gaps;
    for (std::int64_t i = 0; i < columns.size; ++i)
        frequencies.push_back(scene.cell(0, i).oscillator.frequency);
    for (std::int64_t i = 0; i < rows.size; ++i) gaps.push_back(scene.cell(i, 0).oscillator.gap);
    const double force = scene.scales().force_ratio();
    std::vector<Table> tables{
        {{"/",
          {"frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency"},
          {columns}},
         frequencies},
        {{"/", {"gap_ratio", Number::float64, nan, "1", "gap over cart amplitude"}, {rows}}, gaps}};
    const auto add = [&](const Variable& variable, const Numbers& values) {
        tables.push_back({{"/", variable, {rows, columns}}, values});
    };
    add({"regime", Number::int8, regime::regime_not_computed, "",
         "regime of the steady state, in the coarse map", cell::regime_names},
        numbers_of(found.sites, [](const Site& s) { return static_cast<int>(s.regime); }));
    add({"impacts", Number::int32, 0, "1", "p of z = p/q in the coarse map"},
        numbers_of(found.sites, [](const Site& s) { return s.impacts; }));
    add({"period", Number::int32, 0, "1", "q of z = p/q in the coarse map"},
        numbers_of(found.sites, [](const Site& s) { return s.period; }));
    add({"peak_force_ratio", Number::float64, nan, "1",
         "largest impact force over the hammer's weight, in the coarse map"},
        numbers_of(found.sites, [&](const Site& s) { return force * s.peak_force; }));
    return tables;
}

}  // namespace

std::vector<map_file::Table> tables_of(const scene::Scene& scene, const Findings& found) {
    std::vector<CurvePoint> points;
    std::vector<Special> specials;
    std::vector<Crossing> crossings;
    Numbers first;
    Numbers special_curve;
    Numbers crossing_curve;
    for (const Curve& curve : found.curves) {
        first.push_back(static_cast<double>(points.size()));
        special_curve.insert(special_curve.end(), curve.specials.size(), static_cast<double>(first.size() - 1));
        crossing_curve.insert(crossing_curve.end(), curve.crossings.size(),
                              static_cast<double>(first.size() - 1));
        crossings.insert(crossings.end(), curve.crossings.begin(), curve.crossings.end());
        points.insert(points.end(), curve.points.begin(), curve.points.end());
        specials.insert(specials.end(), curve.specials.begin(), curve.specials.end());
    }
    const double force = scene.scales().force_ratio();

    // clang-format off
    Columns curves("/", "curve", std::ssize(found.curves));
    curves.add_counter("number of the curve");
    curves.add({"curve_kind", Number::int8, -128, "", "what happens to the orbit there", kind_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.kind); }));
    curves.add({"curve_impacts", Number::int32, -1, "1", "p of z = p/q, of the orbit on the stable side"}, numbers_of(found.curves, [](const Curve& c) { return c.impacts; }));
    curves.add({"curve_period", Number::int32, -1, "1", "q of z = p/q, of the orbit on the stable side"}, numbers_of(found.curves, [](const Curve& c) { return c.period; }));
    curves.add({"curve_first", Number::int64, -1, "1", "number of the curve's first point"}, first);
    curves.add({"curve_points", Number::int64, -1, "1", "points of the curve, in their order along it"}, numbers_of(found.curves, [](const Curve& c) { return c.points.size(); }));
    curves.add({"curve_begin", Number::int8, -128, "", "why the curve has no point before its first", end_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.begins); }));
    curves.add({"curve_end", Number::int8, -128, "", "why the curve has no point after its last", end_names}, numbers_of(found.curves, [](const Curve& c) { return static_cast<int>(c.ends); }));

    Columns of_points("/", "point", std::ssize(points));
    of_points.add_counter("number of the point");
    of_points.add({"point_frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency"}, numbers_of(points, [](const CurvePoint& p) { return p.place.frequency; }));
    of_points.add({"point_gap_ratio", Number::float64, nan, "1", "gap over cart amplitude"}, numbers_of(points, [](const CurvePoint& p) { return p.place.gap; }));
    of_points.add({"point_multiplier", Number::float64, nan, "1", "Floquet multiplier largest in size, with the sign of its real part; of a grazing, of the orbit without the impact"}, numbers_of(points, [](const CurvePoint& p) { return p.multiplier; }));
    of_points.add({"point_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(points, [&](const CurvePoint& p) { return force * p.peak_force; }));
    of_points.add({"point_residual", Number::float64, nan, "1", "largest error of the defining equations, relative to the hammer's velocity"}, numbers_of(points, [](const CurvePoint& p) { return p.residual; }));

    Columns of_specials("/", "special", std::ssize(specials));
    of_specials.add_counter("number of the special point");
    of_specials.add({"special_kind", Number::int8, -128, "", "what meets at the point", special_names}, numbers_of(specials, [](const Special& s) { return static_cast<int>(s.kind); }));
    of_specials.add({"special_frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency"}, numbers_of(specials, [](const Special& s) { return s.place.frequency; }));
    of_specials.add({"special_gap_ratio", Number::float64, nan, "1", "gap over cart amplitude"}, numbers_of(specials, [](const Special& s) { return s.place.gap; }));
    of_specials.add({"special_curve", Number::int32, -1, "1", "number of the curve on which it was found"}, special_curve);

    Columns of_crossings("/", "crossing", std::ssize(crossings));
    of_crossings.add_counter("number of the crossing");
    of_crossings.add({"crossing_curve", Number::int32, -1, "1", "number of the curve that has one of the gaps of curves.gap_ratio there"}, crossing_curve);
    of_crossings.add({"crossing_frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency"}, numbers_of(crossings, [](const Crossing& c) { return c.place.frequency; }));
    of_crossings.add({"crossing_gap_ratio", Number::float64, nan, "1", "gap over cart amplitude"}, numbers_of(crossings, [](const Crossing& c) { return c.place.gap; }));
    of_crossings.add({"crossing_multiplier", Number::float64, nan, "1", "as point_multiplier"}, numbers_of(crossings, [](const Crossing& c) { return c.multiplier; }));
    of_crossings.add({"crossing_peak_force_ratio", Number::float64, nan, "1", "largest impact force over the hammer's weight"}, numbers_of(crossings, [&](const Crossing& c) { return force * c.peak_force; }));

    Columns live("/run", "curve", std::ssize(found.curves));
    live.add_counter("number of the curve");
    live.add({"curve_seconds", Number::float64, nan, "s", "time that tracing the curve took"}, found.seconds);
    // clang-format on

    std::vector<Table> tables = coarse_map(scene, found);
    const auto append = [&](const Columns& columns) {
        if (columns.tables().front().values.empty()) return;  // a dimension has a size
        tables.insert(tables.end(), columns.tables().begin(), columns.tables().end());
    };
    for (const Columns* each : {&curves, &of_points, &of_specials, &of_crossings}) append(*each);
    const auto scalar = [&](const char* name, const char* meaning, std::int64_t value) {
        tables.push_back(
            {{"/edges", Variable{name, Number::int64, -1, "1", meaning}, {}}, {static_cast<double>(value)}});
    };
    scalar("count", "edges of the coarse map between orbits up to the period, or one and no impact",
           found.edges.edges);
    scalar("on_curve", "of these, within one cell of a curve", found.edges.on_curve);
    scalar("basin", "of these, where the motion of one side lives on the other, too, so that the start decides",
           found.edges.basin);
    append(live);  // the group to which the facts of the run are added
    return tables;
}

}  // namespace peterka::curves
