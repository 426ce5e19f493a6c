// The tables of a trace.
//
// A stand-alone trace gives its rig, operating point and start. A trace of a map file's cell takes all of them
// from the job in that file; the cell is selected by its indices, or as the one nearest to given values.
#pragma once

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"
#include "job/schema_cell_of_map.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_settings.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Trace& trace) {
    table.choice({"from", "where the trace begins: start (transient included) or steady_state"}, trace.from);
    table.integer(
        {"cycles", "forcing cycles shown"}, trace.cycles,
        from_to<std::int64_t>(1, 10'000, "a trace shows whole forcing cycles, as many as one can look at"));
    table.number({"duration_s", "time shown instead with a cart at rest, of frequency 0 [s]"}, trace.duration_s,
                 not_negative("a trace runs forward in time"));
    table.integer({"samples_per_cycle", "samples per forcing cycle, or per natural period of a cart at rest"},
                  trace.samples_per_cycle, from_to<std::int64_t>(4, 1'000'000, "fewer samples show no motion"));
    table.number(
        {"impact_window_s", "time shown closely around the hardest impact, 0: three times its contact [s]"},
        trace.impact_window_s, not_negative("a window has a length"));
    table.integer({"impact_samples", "samples in that window"}, trace.impact_samples,
                  from_to<std::int64_t>(10, 1'000'000, "fewer samples show no impact"));
    table.number(
        {"spectrum_to_hz", "largest frequency of the spectra [Hz]"}, trace.spectrum_to_hz,
        from_to(1e-3, 1e6, "a spectrum has a largest frequency, and no stop is known beyond a megahertz"));
}

inline constexpr Quantity trace_frequency_ratio{
    "frequency_ratio", "excitation frequency over natural frequency, Omega/omega; 0: at rest [1]",
    from_to(0.0, frequency_ratio.range.high,
            "the cart vibrates or is at rest, and its frequency is a finite magnitude"),
    "0.0", "4.5"};
inline constexpr Quantity trace_frequency_hz{"frequency_hz",
                                             "excitation frequency Omega/(2 pi); 0: at rest [Hz]",
                                             not_negative("the cart vibrates or is at rest"), "0.0", "20.25"};

// The rig and the cell of a map file.
template <typename Walker>
void describe_trace_of_map(Walker& file, Job& job) {
    file.refuse("rig",
                "is that of the job in the file that trace.map names; a cell is followed as it was computed; "
                "remove this key");
    for (const auto* name : {"solver", "steady_state"}) {
        file.refuse(
            name,
            "is that of the job in the file that trace.map names; a cell is followed as it was computed; "
            "remove this table");
    }
    describe_values_of_cell(file, job.cell, {"operating_point", "start", "hammer", "cart", "contact"});
    file.rule({"trace"}, [&] {
        Job driven = job;  // a map's cart vibrates; its operating point is unknown until the file is read
        driven.operating_point = {1, 0};
        return rule_of_trace(driven);
    });
}

template <typename Walker>
void describe_trace_of_rig(Walker& file, Job& job) {
    file.table(place_key("place of the cell in the plane"), [&](auto& table) {
        describe_frequency(table, job.operating_point, trace_frequency_ratio, trace_frequency_hz);
        describe_gap(table, job.operating_point);
    });
    settle_place(job);
    describe_start(file, job);
    file.rule({"operating_point", "hammer", "cart"}, [&] { return rule_of_place(job); });
    file.rule({"operating_point", "trace", "hammer"}, [&] { return rule_of_trace(job); });
    file.rule({"start", "hammer", "cart"}, [&] { return rule_of_starts(job); });
    file.rule({"operating_point", "start", "contact"}, [&] { return rule_of_rigid_stop(job); });
}

template <typename Walker>
void refuse_other_tables_in_trace(Walker& file) {
    file.refuse(
        "axes",
        "belongs to a map or basin; a trace follows one cell, see [operating_point]; remove this table");
    file.refuse("starts", "is for maps; a trace follows one start; remove this table");
    file.refuse("uncertainty", "is for maps and sweeps; a trace follows one rig; remove this table");
    file.refuse("noise", "is for maps and sweeps; a trace follows an undisturbed motion; remove this table");
    file.refuse("refine", "is for maps; a trace follows one cell; remove this table");
    file.refuse("audit", "is for maps; a trace follows one cell with one engine; remove this table");
    file.refuse("certificate",
                "is for maps, basins and sweeps; a trace shows one motion in time; remove this table");
    file.refuse("basin", "belongs to kind = \"basin\"; a trace has trace.map; remove this table");
    file.refuse("study", "belongs to kind = \"study\"; a trace compares nothing; remove this table");
    file.refuse("curves", "belongs to kind = \"curves\"; a trace follows one cell; remove this table");
    file.refuse("sweep", "belongs to kind = \"sweep\"; a trace follows one cell; remove this table");
    file.refuse("limits", "is for maps; a trace that fails says so; remove this table");
}

}  // namespace peterka::job
