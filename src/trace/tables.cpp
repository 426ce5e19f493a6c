#include "trace/tables.hpp"

#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace peterka::trace {

namespace {

using hdf5::Number;
using hdf5::Variable;
using map_file::Dimension;
using map_file::Table;
using scene::Scales;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A column of a table: its name, and its value for a row of this kind.
template <class Row>
struct Column {
    Variable variable;
    std::function<double(const Row&)> value;
};

constexpr Variable real(const char* name, const char* units, const char* long_name) {
    return {name, Number::float64, nan, units, long_name};
}

// One table per column; the first one holds the dimension's own coordinates.
template <class Row>
void add_columns(std::vector<Table>& tables, const char* group, std::span<const Row> rows,
                 const std::vector<Column<Row>>& columns) {
    const Dimension dimension{columns.front().variable.name, std::ssize(rows)};
    for (const Column<Row>& column : columns) {
        Table table{{group, column.variable, {dimension}}, {}};
        table.values.reserve(rows.size());
        for (const Row& row : rows) table.values.push_back(column.value(row));
        tables.push_back(std::move(table));
    }
}

struct Shown {
    Instant instant;
    Quantities is;
};

std::vector<Shown> shown(const std::vector<Instant>& instants, const scene::Oscillator<double>& oscillator) {
    std::vector<Shown> rows;
    rows.reserve(instants.size());
    for (const Instant& instant : instants) rows.push_back({instant, quantities(oscillator, instant)});
    return rows;
}

// clang-format off
std::vector<Column<Shown>> columns_of_motion(const Scales& scales, double period) {
    const double per_omega = 1 / scales.frequency_rad_per_s;
    const double speed = scales.length_m * scales.frequency_rad_per_s;
    const double acceleration = speed * scales.frequency_rad_per_s;
    const double force = scales.force_ratio();
    return {
        {real("time", "s", "time since the trace began"), [=](const Shown& row) { return row.instant.time * per_omega; }},
        {real("cycle", "1", "the same in forcing cycles, or in natural periods where the cart is at rest"), [=](const Shown& row) { return row.instant.time / period; }},
        {real("hammer_displacement_ratio", "1", "displacement of the hammer over cart amplitude, x/A0"), [](const Shown& row) { return row.is.hammer(); }},
        {real("cart_displacement_ratio", "1", "displacement of the cart over its amplitude, y/A0"), [](const Shown& row) { return row.is.cart; }},
        {real("relative_displacement_ratio", "1", "displacement of the hammer in the cart over cart amplitude, (x - y)/A0; the stop is at gap_ratio"), [](const Shown& row) { return row.is.relative; }},
        {real("hammer_velocity", "m/s", "velocity of the hammer, x'"), [=](const Shown& row) { return row.is.hammer_velocity() * speed; }},
        {real("cart_velocity", "m/s", "velocity of the cart, y'"), [=](const Shown& row) { return row.is.cart_velocity * speed; }},
        {real("relative_velocity", "m/s", "velocity of the hammer in the cart, x' - y'"), [=](const Shown& row) { return row.is.relative_velocity * speed; }},
        {real("hammer_acceleration", "m/s^2", "acceleration of the hammer, x''"), [=](const Shown& row) { return row.is.acceleration * acceleration; }},
        {real("force_ratio", "1", "force of the stop on the hammer over its weight, F/(m g0), positive against the hammer"), [=](const Shown& row) { return row.is.force * force; }},
    };
}

struct Counted {
    double index;
    Impact impact;
};

std::vector<Column<Counted>> columns_of_impacts(const Trace& trace, const Scales& scales) {
    const double per_omega = 1 / scales.frequency_rad_per_s;
    const double speed = scales.length_m * scales.frequency_rad_per_s;
    const double force = scales.force_ratio();
    const double period = trace.course.oscillator.period();
    const auto oscillator = trace.course.oscillator;
    return {
        {{"impact", Number::int32, -1, "1", "number of the impact, from 0"}, [](const Counted& row) { return row.index; }},
        {real("touch_time", "s", "time of the first touch since the trace began"), [=](const Counted& row) { return row.impact.time * per_omega; }},
        {real("touch_cycle", "1", "the same in forcing cycles"), [=](const Counted& row) { return row.impact.time / period; }},
        {real("impact_speed", "m/s", "speed of the hammer against the stop at first touch"), [=](const Counted& row) { return row.impact.speed * speed; }},
        {real("touch_force_ratio", "1", "force to which the stop jumps at first touch over hammer weight, F/(m g0); NaN on a rigid stop"), [=](const Counted& row) { return force_at_touch(oscillator, row.impact.speed) * force; }},
        {real("peak_force_ratio", "1", "peak force of the impact over hammer weight, F/(m g0); NaN on a rigid stop, and where the end of the trace cuts the contact"), [=](const Counted& row) { return row.impact.record.peak_force * force; }},
        {real("impulse", "N s", "impulse of the impact; NaN where the end of the trace cuts the contact"), [=](const Counted& row) { return row.impact.record.impulse * scales.force_n * per_omega; }},
        {real("contact_time", "s", "time for which the stop presses; NaN where the end of the trace cuts the contact"), [=](const Counted& row) { return row.impact.record.contact_time * per_omega; }},
        {real("work", "J", "work that the impact takes from the hammer's motion in the cart; NaN where the end of the trace cuts the contact"), [=](const Counted& row) { return row.impact.record.work * scales.force_n * scales.length_m; }},
    };
}

struct Line {
    double frequency;
    double force;
    double acceleration;
};

constexpr Variable frequency_axis = real("frequency", "Hz", "frequency");
constexpr Variable force_amplitude = real("force_amplitude", "N", "amplitude of the force of the stop: Fourier series over one period of an orbit, over the whole trace elsewhere");
constexpr Variable acceleration_amplitude = real("acceleration_amplitude", "m/s^2", "amplitude of the acceleration of the hammer, x'', in the same way");
constexpr Variable pulse_spectrum = real("force_spectrum", "N s", "size of the Fourier integral of the hardest impact's force; its impulse at 0 Hz");
constexpr Variable flight_amplitude = real("flight_acceleration_amplitude", "m/s^2", "2/T times the size of the Fourier integral of x'' over the flight after the hardest impact, of length T");
// clang-format on

void add_spectrum(std::vector<Table>& tables, const char* group, const Spectrum& spectrum, const Scales& scales,
                  const std::pair<Variable, double>& force, const std::pair<Variable, double>& acceleration) {
    std::vector<Line> lines;
    const double hertz = scales.frequency_rad_per_s / (2 * std::numbers::pi);
    for (std::size_t n = 0; n < spectrum.force.size(); ++n) {
        lines.push_back({static_cast<double>(n) * spectrum.step * hertz, spectrum.force[n] * force.second,
                         spectrum.acceleration[n] * acceleration.second});
    }
    add_columns<Line>(tables, group, lines,
                      {{frequency_axis, [](const Line& line) { return line.frequency; }},
                       {force.first, [](const Line& line) { return line.force; }},
                       {acceleration.first, [](const Line& line) { return line.acceleration; }}});
}

void add_hardest(std::vector<Table>& tables, const Trace& trace, const Scales& scales) {
    const HardImpact& hardest = *trace.hardest;
    const auto& oscillator = trace.course.oscillator;
    const double per_omega = 1 / scales.frequency_rad_per_s;
    const double touch = trace.impacts[hardest.index].time;
    auto columns = columns_of_motion(scales, oscillator.period());
    columns.push_back({real("time_from_touch", "s", "time since the first touch of this impact"),
                       [=](const Shown& row) { return (row.instant.time - touch) * per_omega; }});
    const auto rows = shown(hardest.instants, oscillator);
    add_columns<Shown>(tables, "/impact", rows, columns);
    const auto scalar = [&](const Variable& variable, double value) {
        tables.push_back({{"/impact", variable, {}}, {value}});
    };
    scalar({"impact", Number::int32, -1, "1", "which of the impacts this is, the hardest one"},
           static_cast<double>(hardest.index));
    if (hardest.peak.phase == Phase::contact && !std::isnan(trace.impacts[hardest.index].record.peak_force)) {
        scalar(real("peak_time", "s", "time of the peak force since the trace began"),
               hardest.peak.time * per_omega);
        scalar(real("peak_force_ratio", "1", "peak force of this impact over hammer weight, F/(m g0)"),
               quantities(oscillator, hardest.peak).force * scales.force_ratio());
    }
    if (!hardest.spectrum) return;
    const double acceleration = scales.length_m * scales.frequency_rad_per_s * scales.frequency_rad_per_s;
    add_spectrum(tables, "/impact_spectrum", *hardest.spectrum, scales,
                 {pulse_spectrum, scales.force_n * per_omega}, {flight_amplitude, acceleration});
}

}  // namespace

std::vector<Table> tables_of(const Trace& trace, const Scales& scales) {
    std::vector<Table> tables;
    const auto& oscillator = trace.course.oscillator;
    const auto rows = shown(trace.instants, oscillator);
    add_columns<Shown>(tables, "/", rows, columns_of_motion(scales, oscillator.period()));
    if (!trace.impacts.empty()) {
        std::vector<Counted> counted;
        for (const Impact& impact : trace.impacts)
            counted.push_back({static_cast<double>(counted.size()), impact});
        add_columns<Counted>(tables, "/impacts", counted, columns_of_impacts(trace, scales));
    }
    if (trace.hardest) add_hardest(tables, trace, scales);
    const double acceleration = scales.length_m * scales.frequency_rad_per_s * scales.frequency_rad_per_s;
    add_spectrum(tables, "/spectrum", trace.spectrum, scales, {force_amplitude, scales.force_n},
                 {acceleration_amplitude, acceleration});
    return tables;
}

job::Job with_proofs(job::Job job) {
    using enum job::OptionalField;
    job.kind = job::Kind::map;
    job.output.fields = {multiplier, lyapunov, sensitivity, orbit};
    return job;
}

std::vector<Table> cell_tables(const char* group, const quantities::StoredCell& cell, const job::Job& job) {
    std::vector<Table> tables;
    for (const quantities::Field& field : quantities::stored_fields(job)) {
        tables.push_back({{group, field.variable, {}}, {field.quantity->load(cell)}});
    }
    return tables;
}

}  // namespace peterka::trace
