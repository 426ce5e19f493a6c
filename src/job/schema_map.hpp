// The tables of a map: its axes over any two numbers that may differ from cell to cell, and what all cells
// share.
#pragma once

#include "job/axis_quantity.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/rules.hpp"
#include "job/schema_plane.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Refine& refine) {
    table.integer(
        {"levels", "first every 2^levels-th cell, then only where needed; 0 computes every cell"},
        refine.levels,
        from_to<std::int64_t>(0, 6, "on a coarser grid than every 64th cell whole regions go unseen"));
}

// Frequency and gap, unless they are axes.
template <typename Walker>
void describe_shared_place(Walker& file, Job& job, bool frequency, bool gap, std::string_view why_none) {
    if (!frequency && !gap) return file.refuse("operating_point", why_none);
    Key shared = place_key("frequency or gap that all cells share");
    if (!gap) {
        shared.example = "frequency_ratio";
        shared.example_in_si = "frequency_hz";
    } else if (!frequency) {
        shared.example = "gap_ratio";
        shared.example_in_si = "gap_m";
    }
    file.table(shared, [&](auto& table) {
        constexpr auto why = "is given already, as an axis or in a list; remove this key";
        if (frequency) {
            describe_frequency(table, job.operating_point);
        } else {
            for (const Quantity& other : {frequency_ratio, frequency_hz}) table.refuse(other.name, why);
        }
        if (gap) {
            describe_gap(table, job.operating_point);
        } else {
            for (const Quantity& other : {gap_ratio, gap_m}) table.refuse(other.name, why);
        }
    });
    settle_place(job);
}

// The plane of a map and the start of its cells.
template <typename Walker>
void describe_plane(Walker& file, Job& job) {
    bool are_known = true;
    const Key plane{.name = "axes",
                    .meaning = "plane of the map",
                    .example = "[axes.frequency_ratio] and [axes.gap_ratio]",
                    .example_in_si = "[axes.frequency_hz] and [axes.gap_m]"};
    file.table(plane, [&](auto& axes) {
        const auto chosen = axes.choose_axes(job);
        are_known = chosen.are_known;
        if (chosen.count > 0) describe_axis(axes, job.columns, quantity(column_key(job)));
        if (chosen.count > 1) describe_axis(axes, job.rows, quantity(row_key(job)));
    });
    take_first_values(job);
    if (!are_known) {
        file.skip({"operating_point"});
    } else if (job.kind != Kind::study) {
        describe_shared_place(
            file, job, !has_axis(job, is_frequency), !has_axis(job, is_gap),
            job.kind == Kind::curves
                ? "belongs to a basin; curves cross the plane of their axes; remove this table"
                : "belongs to a basin; a map covers the plane of its axes; remove this table");
    }
    describe_start(file, job);
    file.rule({"axes", "operating_point", "hammer", "cart"}, [&] { return rule_of_place(job); });
    file.rule({"axes", "operating_point", "hammer", "cart"}, [&] { return rule_of_rigid_stop(job); });
}

template <typename Walker>
void describe_map(Walker& file, Job& job) {
    describe_plane(file, job);
    file.table({"refine", "cells that are filled from those around them instead of being computed"},
               [&](auto& table) { describe(table, job.refine); });
}

}  // namespace peterka::job
