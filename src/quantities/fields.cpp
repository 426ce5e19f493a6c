#include "quantities/fields.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace peterka::quantities {

namespace {

using job::ContactLaw;
using job::OptionalField;
using regime::CellResult;

constexpr Always always;
constexpr auto table_too = InAttractorTable::yes;
constexpr double not_computed = regime::regime_not_computed;

// clang-format off
constexpr Field fields[] = {
    {{"regime", hdf5::Number::int8, not_computed, "", "regime of the steady state", regime_names}, always, member<&CellResult::regime>, table_too},
    {{"status", hdf5::Number::int8, not_computed, "", "why a cell is unresolved or failed, or what its proof leaves open", status_names}, always, member<&CellResult::status>},
    {{"computed", hdf5::Number::int8, not_computed, "", "whether the cell is computed or filled from computed cells around it", computed_names}, Refined{}, member<&CellResult::computed>},
    {{"engine", hdf5::Number::int8, not_computed, "", "engine that carried the cell; exact leaves a cubic spring out", engine_names}, always, member<&CellResult::engine>},
    {{"impacts", hdf5::Number::int32, -1, "1", "impacts p of z = p/q"}, always, member<&CellResult::impacts>, table_too},
    {{"period", hdf5::Number::int32, -1, "1", "period q of z = p/q in forcing cycles"}, always, member<&CellResult::period>, table_too},
    {{"peak_force_ratio", hdf5::Number::float64, regime::unknown, "1", "peak impact force over hammer weight, F/(m g0)"}, always, member<&CellResult::peak_force>, table_too},
    {{"jump", hdf5::Number::int8, not_computed, "", "whether the peak force jumps on the way to this point from the one before it in the branch", jump_names}, Swept{}, member<&CellResult::jump>},
    {{"chatter", hdf5::Number::int8, not_computed, "", "whether impacts on the rigid stop accumulate to rest; each such chatter counts as one impact", chatter_names}, ContactLaw::restitution, member<&CellResult::chatter>},
    {{"impact_rate", hdf5::Number::float64, regime::unknown, "1", "impacts per forcing cycle"}, always, member<&CellResult::impact_rate>},
    {{"cycles", hdf5::Number::int32, -1, "1", "forcing cycles spent"}, always, member<&CellResult::cycles>},
    {{"observed_cycles", hdf5::Number::int32, -1, "1", "forcing cycles for which a chaotic or unresolved motion was followed"}, always, member<&CellResult::observed_cycles>},
    {{"multiplier", hdf5::Number::float64, regime::unknown, "1", "largest absolute Floquet multiplier of the orbit"}, OptionalField::multiplier, member<&CellResult::multiplier>},
    {{"lyapunov", hdf5::Number::float64, regime::unknown, "1", "largest Lyapunov exponent per forcing cycle"}, OptionalField::lyapunov, member<&CellResult::lyapunov>},
    {{"sensitivity", hdf5::Number::float64, regime::unknown, "1", "largest growth of an error that came in at any moment, ln G"}, OptionalField::sensitivity, member<&CellResult::sensitivity>},
    {{"orbit_displacement", hdf5::Number::float64, regime::unknown, "1", "orbit at forcing phase 0, (x - y)/A0"}, OptionalField::orbit, member<&CellResult::orbit_displacement>, table_too},
    {{"orbit_velocity", hdf5::Number::float64, regime::unknown, "1", "orbit at forcing phase 0, (x' - y')/(A0 omega)"}, OptionalField::orbit, member<&CellResult::orbit_velocity>, table_too},
    {{"impact_speed", hdf5::Number::float64, regime::unknown, "m/s", "largest speed of the hammer against the stop at first touch"}, OptionalField::impact_speed, member<&CellResult::impact_speed>},
    {{"impulse", hdf5::Number::float64, regime::unknown, "N s", "largest impulse of one impact"}, OptionalField::impulse, member<&CellResult::impulse>},
    {{"contact_time", hdf5::Number::float64, regime::unknown, "s", "longest time for which the stop presses in one impact"}, OptionalField::contact_time, member<&CellResult::contact_time>},
    {{"contact_power_w", hdf5::Number::float64, regime::unknown, "W", "mean power that the impacts take from the hammer's motion against the cart"}, OptionalField::contact_power, member<&CellResult::contact_power>},
    {{"max_displacement", hdf5::Number::float64, regime::unknown, "m", "largest displacement of the hammer from its rest in the cart, |x - y|"}, OptionalField::max_displacement, member<&CellResult::max_displacement>},
    {{"peak_force_mean_ratio", hdf5::Number::float64, regime::unknown, "1", "mean of the largest impact force of each forcing cycle, F/(m g0)"}, OptionalField::force_per_cycle, member<&CellResult::peak_force_mean>},
    {{"peak_force_q95_ratio", hdf5::Number::float64, regime::unknown, "1", "95 % quantile of the largest impact force of each forcing cycle, F/(m g0)"}, OptionalField::force_per_cycle, member<&CellResult::peak_force_q95>},
    {{"window_cycles", hdf5::Number::int32, -1, "1", "forcing cycles of which these are mean and quantile"}, OptionalField::force_per_cycle, member<&CellResult::window_cycles>},
    {{"last_impact", hdf5::Number::int32, regime::goes_on, "1", "forcing cycles until the last impact; none where impacts go on or the cell was filled"}, OptionalField::last_impact, member<&CellResult::last_impact>},
    {{"attractors", hdf5::Number::int32, -1, "1", "attractors on which the starts of the cell end"}, ManyStarts{}, member<&CellResult::attractors>},
    {{"start_attractor", hdf5::Number::int32, -1, "1", "attractor on which [start] ends; -1 for none of those that are kept"}, ManyStarts{}, member<&CellResult::start_attractor>},
};
// clang-format on

bool stores(const job::Job& job, const Field& field) {
    if (const auto* law = std::get_if<ContactLaw>(&field.stored)) return law_of(job.contact) == *law;
    if (std::holds_alternative<Refined>(field.stored)) return job.refine.levels > 0;
    if (std::holds_alternative<ManyStarts>(field.stored)) return job.starts.count > 0;
    if (std::holds_alternative<Swept>(field.stored)) return job.kind == job::Kind::sweep;
    const auto* asked = std::get_if<OptionalField>(&field.stored);
    if (asked == nullptr) return true;
    return job.output.has(*asked) || (job.kind == job::Kind::basin && *asked == OptionalField::orbit);
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

StoredCell in_file_units(const CellResult& cell, const scene::Scales& scales) {
    StoredCell stored = cell;
    const double speed = scales.length_m * scales.frequency_rad_per_s;  // A0 omega
    stored.peak_force *= scales.force_ratio();
    stored.peak_force_mean *= scales.force_ratio();
    stored.peak_force_q95 *= scales.force_ratio();
    stored.impact_speed *= speed;
    stored.impulse *= scales.force_n / scales.frequency_rad_per_s;
    stored.contact_time /= scales.frequency_rad_per_s;
    stored.contact_power *= scales.force_n * speed;
    stored.max_displacement *= scales.length_m;
    for (const Field& field : fields) {
        const double value = field.member.load(stored);
        if (std::isnan(value)) field.member.store(stored, regime::unknown);
    }
    return stored;
}

}  // namespace peterka::quantities
