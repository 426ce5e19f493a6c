// The tables of a job that say which cells it has: the axes of a map or basin, and where the hammer starts.
#pragma once

#include <limits>

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"

namespace peterka::job {

// Quantities that stand on an axis, at an operating point or in a start.
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
inline constexpr Quantity displacement_ratio{
    "displacement_ratio", "start of the hammer, x(0)/A0 [1]",
    from_to(-1e9, 1e9, "a start further away loses the cart's motion in rounding"), "-6.0", "6.0"};
inline constexpr Quantity velocity_ratio{
    "velocity_ratio", "start of the hammer, x'(0)/(A0 omega) [1]",
    from_to(-1e9, 1e9, "a faster start loses the cart's motion in rounding"), "-6.0", "6.0"};

template <typename Walker>
void describe(Walker& table, Axis& axis, const Quantity& quantity) {
    table.number({"from", "first value", quantity.from}, axis.from, quantity.range);
    table.number({"to", "last value", quantity.to}, axis.to, quantity.range);
    table.integer({"points", "number of values, both ends included", "512"}, axis.points,
                  from_to<std::int64_t>(2, std::numeric_limits<std::int32_t>::max(),
                                        "an axis has two ends, and its points are counted in 32 bits"));
    table.choice({"scale", "spacing of the values, linear or log"}, axis.scale);
    table.rule({"from", "to"}, [&] { return rule_of_direction(quantity.name, axis); });
    table.rule({"from", "scale"}, [&] { return rule_of_logarithm(quantity.name, axis); });
    table.rule({"from", "to", "points", "scale"}, [&] { return rule_of_resolution(quantity.name, axis); });
}

template <typename Walker>
void describe_axes(Walker& axes, Job& job, const Quantity& columns, const Quantity& rows) {
    axes.table({columns.name, columns.meaning, "from, to and points"},
               [&](auto& table) { describe(table, job.columns, columns); });
    axes.table({rows.name, rows.meaning, "from, to and points"},
               [&](auto& table) { describe(table, job.rows, rows); });
}

template <typename Walker>
void describe_start(Walker& file, Job& job) {
    file.table({"start", "start of the hammer at t = 0, absolute (not relative to the cart)"},
               [&](auto& table) {
                   table.number({displacement_ratio.name, displacement_ratio.meaning},
                                job.start.displacement_ratio, displacement_ratio.range);
                   table.number({velocity_ratio.name, velocity_ratio.meaning}, job.start.velocity_ratio,
                                velocity_ratio.range);
               });
}

// The plane of a map and the start of its cells.
template <typename Walker>
void describe_plane(Walker& file, Job& job) {
    file.table({"axes", "plane of the map", "[axes.frequency_ratio] and [axes.gap_ratio]"}, [&](auto& axes) {
        describe_axes(axes, job, frequency_ratio, gap_ratio);
        constexpr auto why =
            "is an axis of a basin; a map starts every cell alike; give one value under [start]";
        axes.refuse(displacement_ratio.name, why);
        axes.refuse(velocity_ratio.name, why);
    });
    describe_start(file, job);
}

template <typename Walker>
void describe(Walker& table, Refine& refine) {
    table.integer(
        {"levels", "first every 2^levels-th cell, then only where needed; 0 computes every cell"},
        refine.levels,
        from_to<std::int64_t>(0, 6, "on a coarser grid than every 64th cell whole regions go unseen"));
}

template <typename Walker>
void describe_map(Walker& file, Job& job) {
    describe_plane(file, job);
    file.table({"refine", "cells that are filled from those around them instead of being computed"},
               [&](auto& table) { describe(table, job.refine); });
    file.refuse("operating_point", "belongs to a basin; a map covers the plane of its axes; remove this table");
    file.rule({"axes"}, [&] {
        return rule_of_rigid_stop(job.contact, "start.displacement_ratio", job.start.displacement_ratio,
                                  "the lowest axes.gap_ratio", job.rows.from);
    });
}

template <typename Walker>
void describe_basin(Walker& file, Job& job) {
    file.table(
        {"operating_point", "place in the plane at which the basin is drawn", "frequency_ratio and gap_ratio"},
        [&](auto& table) {
            table.number({frequency_ratio.name, frequency_ratio.meaning, "1.8"},
                         job.operating_point.frequency_ratio, frequency_ratio.range);
            table.number({gap_ratio.name, gap_ratio.meaning, "1.6"}, job.operating_point.gap_ratio,
                         gap_ratio.range);
        });
    file.table({"axes", "plane of starts", "[axes.displacement_ratio] and [axes.velocity_ratio]"},
               [&](auto& axes) {
                   describe_axes(axes, job, displacement_ratio, velocity_ratio);
                   constexpr auto why =
                       "is an axis of a map; a basin is drawn at one place; give one value under "
                       "[operating_point]";
                   axes.refuse(frequency_ratio.name, why);
                   axes.refuse(gap_ratio.name, why);
               });
    file.refuse("starts", "is for maps; every cell of a basin is a start; remove this table");
    file.refuse("start", "belongs to a map; a basin starts from every point of its axes; remove this table");
    file.refuse("refine",
                "is for maps; the edges of basins are fractal, so every start is computed; remove this table");
    file.rule({"axes"}, [&] {
        return rule_of_rigid_stop(job.contact, "axes.displacement_ratio.to", job.columns.to,
                                  "operating_point.gap_ratio", job.operating_point.gap_ratio);
    });
}

}  // namespace peterka::job
