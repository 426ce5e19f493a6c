#include "output/fields.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace peterka::output {

namespace {

using job::OptionalField;
using regime::CellResult;

constexpr std::nullopt_t always = std::nullopt;
constexpr auto table_too = InAttractorTable::yes;
constexpr double not_computed = regime::regime_not_computed;
constexpr double nan = regime::unknown;

// clang-format off
constexpr Field fields[] = {
    {{"regime", Number::int8, not_computed, "", "regime of the steady state", regime_names}, always, member<&CellResult::regime>, table_too},
    {{"status", Number::int8, not_computed, "", "why a cell is unresolved or failed", status_names}, always, member<&CellResult::status>},
    {{"engine", Number::int8, not_computed, "", "engine that carried the cell; exact leaves a cubic spring out", engine_names}, always, member<&CellResult::engine>},
    {{"impacts", Number::int32, -1, "1", "impacts p of z = p/q"}, always, member<&CellResult::impacts>, table_too},
    {{"period", Number::int32, -1, "1", "period q of z = p/q in forcing cycles"}, always, member<&CellResult::period>, table_too},
    {{"peak_force_ratio", Number::float64, nan, "1", "peak impact force over hammer weight, F/(m g0)"}, always, member<&CellResult::peak_force>, table_too},
    {{"impact_rate", Number::float64, nan, "1", "impacts per forcing cycle"}, always, member<&CellResult::impact_rate>},
    {{"cycles", Number::int32, -1, "1", "forcing cycles spent"}, always, member<&CellResult::cycles>},
    {{"multiplier", Number::float64, nan, "1", "largest absolute Floquet multiplier of the orbit"}, OptionalField::multiplier, member<&CellResult::multiplier>},
    {{"lyapunov", Number::float64, nan, "1", "largest Lyapunov exponent per forcing cycle"}, OptionalField::lyapunov, member<&CellResult::lyapunov>},
    {{"sensitivity", Number::float64, nan, "1", "largest growth of a start perturbation, ln G"}, OptionalField::sensitivity, member<&CellResult::sensitivity>},
    {{"orbit_displacement", Number::float64, nan, "1", "orbit at forcing phase 0, (x - y)/A0"}, OptionalField::orbit, member<&CellResult::orbit_displacement>, table_too},
    {{"orbit_velocity", Number::float64, nan, "1", "orbit at forcing phase 0, (x' - y')/(A0 omega)"}, OptionalField::orbit, member<&CellResult::orbit_velocity>, table_too},
};
// clang-format on

bool stores(const job::Job& job, const Field& field) {
    if (!field.on_request) return true;
    if (job.kind == job::Kind::basin && *field.on_request == OptionalField::orbit) return true;
    return std::ranges::find(job.output.fields, *field.on_request) != job.output.fields.end();
}

}  // namespace

std::vector<Field> stored_fields(const job::Job& job) {
    std::vector<Field> stored;
    std::ranges::copy_if(fields, std::back_inserter(stored),
                         [&](const Field& field) { return stores(job, field); });
    return stored;
}

std::vector<Field> attractor_fields() {
    std::vector<Field> columns;
    std::ranges::copy_if(fields, std::back_inserter(columns),
                         [](const Field& field) { return field.in_attractor_table == table_too; });
    return columns;
}

StoredCell in_file_units(const CellResult& cell, double force_ratio_per_unit) {
    StoredCell stored = cell;
    stored.peak_force *= force_ratio_per_unit;
    for (const Field& field : fields) {
        const double value = field.member.load(stored);
        if (std::isnan(value)) field.member.store(stored, nan);
    }
    return stored;
}

}  // namespace peterka::output
