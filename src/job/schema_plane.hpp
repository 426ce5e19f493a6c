// What defines the cells of maps, basins and sweeps: axes, operating points and starts.
#pragma once

#include <limits>
#include <optional>

#include "job/axis_quantity.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/settle.hpp"

namespace peterka::job {

// A quantity of an axis, an operating point or a start.
struct Quantity {
    std::string_view name;
    std::string_view meaning;
    Range<double> range;
    std::string_view from;  // examples
    std::string_view to;
};

inline constexpr Quantity frequency_ratio{
    "frequency_ratio", "excitation frequency over natural frequency, Omega/omega [1]",
    from_to(1e-6, 1e6, "the cart must vibrate, and a cycle may last at most a million times the hammer's own"),
    "0.5", "4.5"};
inline constexpr Quantity gap_ratio{
    "gap_ratio", "gap over cart amplitude, gap/A0 [1]",
    from_to(-1e6, 1e6,
            "the stop stands within reach of the hammer, in front of it or (negative) pressed into it"),
    "0.0", "5.0"};
inline constexpr Quantity frequency_hz{"frequency_hz", "excitation frequency Omega/(2 pi) [Hz]",
                                       positive("the cart must vibrate"), "2.25", "20.25"};
inline constexpr Quantity gap_m{
    "gap_m", "gap between hammer and stop [m]",
    from_to(-1e6, 1e6,
            "the stop stands within reach of the hammer, in front of it or (negative) pressed into it"),
    "0.0", "4e-3"};
inline constexpr Quantity displacement_ratio{
    "displacement_ratio", "start of the hammer, x(0)/A0 [1]",
    from_to(-1e9, 1e9, "a start further away loses the cart's motion in rounding"), "-6.0", "6.0"};
inline constexpr Quantity velocity_ratio{
    "velocity_ratio", "start of the hammer, x'(0)/(A0 omega) [1]",
    from_to(-1e9, 1e9, "a faster start loses the cart's motion in rounding"), "-6.0", "6.0"};
inline constexpr Quantity displacement_m{
    "displacement_m", "start of the hammer, x(0) [m]",
    from_to(-1e6, 1e6, "a start further away loses the cart's motion in rounding"), "-5e-3", "5e-3"};
inline constexpr Quantity velocity_m_per_s{
    "velocity_m_per_s", "start of the hammer, x'(0) [m/s]",
    from_to(-1e6, 1e6, "a faster start loses the cart's motion in rounding"), "-0.15", "0.15"};

template <typename Walker>
void describe(Walker& table, Axis& axis, const AxisQuantity& quantity) {
    table.number({"from", "first value", quantity.from}, axis.from, quantity.range);
    table.number({"to", "last value", quantity.to}, axis.to, quantity.range);
    table.integer({"points", "number of values, both ends included", "512"}, axis.points,
                  from_to<std::int64_t>(1, std::numeric_limits<std::int32_t>::max(),
                                        "an axis has a point or more, and they are counted in 32 bits"));
    table.choice({"scale", "spacing of the values, linear or log"}, axis.scale);
    table.rule({"from", "to"}, [&] { return rule_of_direction(quantity.key, axis); });
    table.rule({"from", "scale"}, [&] { return rule_of_logarithm(quantity.key, axis); });
    table.rule({"from", "to", "points", "scale"}, [&] { return rule_of_resolution(quantity.key, axis); });
}

template <typename Walker>
void describe_axis(Walker& axes, Axis& axis, const AxisQuantity& quantity) {
    axes.table({quantity.key, quantity.meaning, "from, to and points"},
               [&](auto& table) { describe(table, axis, quantity); });
}

template <typename Walker>
void describe(Walker& table, Start& start) {
    const auto describe_one = [&](const Quantity& ratios, double& value, const Quantity& si,
                                  std::optional<double>& value_si, std::string_view why) {
        std::optional<double> ratio = value_si ? std::nullopt : std::optional(value);
        table.either({{ratios.name, ratios.meaning}, ratio, ratios.range},
                     {{si.name, si.meaning}, value_si, si.range}, why);
        value = ratio.value_or(0);
    };
    describe_one(displacement_ratio, start.displacement_ratio, displacement_m, start.displacement_m,
                 "either of them sets where the hammer starts");
    describe_one(velocity_ratio, start.velocity_ratio, velocity_m_per_s, start.velocity_m_per_s,
                 "either of them sets how fast the hammer starts");
}

template <typename Walker>
void describe_start(Walker& file, Job& job) {
    file.table({"start", "start of the hammer at t = 0, absolute (not relative to the cart)"},
               [&](auto& table) { describe(table, job.start); });
    settle_start(job);
}

// The table of an operating point.
constexpr Key place_key(std::string_view meaning) {
    return {.name = "operating_point",
            .meaning = meaning,
            .example = "frequency_ratio and gap_ratio",
            .example_in_si = "frequency_hz and gap_m"};
}

// At one operating point: as a ratio or in SI units.
template <typename Walker>
void describe_frequency(Walker& table, OperatingPoint& place, const Quantity& ratios = frequency_ratio,
                        const Quantity& hertz = frequency_hz) {
    std::optional<double> ratio = place.frequency_hz ? std::nullopt : std::optional(place.frequency_ratio);
    table.either({{ratios.name, ratios.meaning, "1.8"}, ratio, ratios.range},
                 {{hertz.name, hertz.meaning, "9.0"}, place.frequency_hz, hertz.range},
                 "either of them sets the excitation frequency");
    place.frequency_ratio = ratio.value_or(0);
}

template <typename Walker>
void describe_gap(Walker& table, OperatingPoint& place) {
    std::optional<double> ratio = place.gap_m ? std::nullopt : std::optional(place.gap_ratio);
    table.either({{gap_ratio.name, gap_ratio.meaning, "1.6"}, ratio, gap_ratio.range},
                 {{gap_m.name, gap_m.meaning, "1e-3"}, place.gap_m, gap_m.range},
                 "either of them sets the gap");
    place.gap_ratio = ratio.value_or(0);
}

template <typename Walker>
void describe_basin(Walker& file, Job& job) {
    const bool has_own_rig = job.cell.map.empty();
    if (has_own_rig) {
        file.table(place_key("place in the plane at which the basin is drawn"), [&](auto& table) {
            describe_frequency(table, job.operating_point);
            describe_gap(table, job.operating_point);
        });
        settle_place(job);
    }
    file.table({.name = "axes",
                .meaning = "plane of starts",
                .example = "[axes.displacement_ratio] and [axes.velocity_ratio]",
                .example_in_si = "[axes.displacement_m] and [axes.velocity_m_per_s]"},
               [&](auto& axes) {
                   axes.choose_axes_of_basin(job);
                   describe_axis(axes, job.columns, quantity(column_key(job)));
                   describe_axis(axes, job.rows, quantity(row_key(job)));
                   constexpr auto why =
                       "is an axis of a map; a basin is drawn at one place; give one value under "
                       "[operating_point]";
                   for (const Quantity& other : {frequency_ratio, gap_ratio, frequency_hz, gap_m}) {
                       axes.refuse(other.name, why);
                   }
               });
    file.refuse("starts", "is for maps; every cell of a basin is a start; remove this table");
    file.refuse("uncertainty", "is for maps and sweeps; a basin is that of one rig; remove this table");
    file.refuse(
        "noise",
        "is for maps and sweeps; its lives are those of attractors, which the cells of a basin share; take a "
        "map of this operating point, or remove this table");
    file.refuse("start", "belongs to a map; a basin starts from every point of its axes; remove this table");
    file.refuse("refine",
                "is for maps; the edges of basins are fractal, so every start is computed; remove this table");
    if (!has_own_rig) return;  // these rules are checked once the rig is known
    file.rule({"operating_point"}, [&] { return rule_of_place(job); });
    file.rule({"axes", "hammer", "cart"}, [&] { return rule_of_starts(job); });
    file.rule({"axes"}, [&] { return rule_of_rigid_stop(job); });
}

}  // namespace peterka::job
