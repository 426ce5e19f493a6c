// The table of a cell's quantities, followed by those of its attractors' quantities, where it has many starts,
// and of the outcomes of the rigs drawn for it. Their rows determine
// - which names [output] fields takes, and what `check` says of them   (job/names.hpp)
// - what a job stores                                                 (job/stored_quantities.hpp)
// - what is measured while a cell is solved                           (regime/solve_cell.cpp)
// - what a refined map fills without computing it                     (refine/fill.hpp)
// - the datasets of the file, their units and words                   (Field of the map file)
// A new quantity is a row here (with its name in OptionalField, if it is only computed on request), its member
// in cell/result.hpp, and what computes it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "cell/result.hpp"

namespace peterka::cell {

// What [output] fields can request, in the order of the table. One name may bring several quantities.
enum class OptionalField {
    multiplier,
    lyapunov,
    sensitivity,
    orbit,
    impact_speed,
    impulse,
    contact_time,
    contact_power,
    max_displacement,
    force_per_cycle,
    last_impact,
    critical_kick,
    force_elasticity,  // by each number of the job
    speed_elasticity,
    force_by_frequency_hz,
    force_by_gap_m,
    force_by_hammer_mass_kg,
    force_by_hammer_natural_frequency_hz,
    force_by_hammer_stiffness_n_per_m,
    force_by_hammer_damping_ns_per_m,
    force_by_hammer_damping_ratio,
    force_by_hammer_cubic_stiffness_n_per_m3,
    force_by_cart_amplitude_m,
    force_by_contact_stiffness_n_per_m,
    force_by_contact_damping_ns_per_m,
    speed_by_frequency_hz,
    speed_by_gap_m,
    speed_by_hammer_mass_kg,
    speed_by_hammer_natural_frequency_hz,
    speed_by_hammer_stiffness_n_per_m,
    speed_by_hammer_damping_ns_per_m,
    speed_by_hammer_damping_ratio,
    speed_by_hammer_cubic_stiffness_n_per_m3,
    speed_by_cart_amplitude_m,
    speed_by_contact_coefficient,
};

// The unit in the file; scene/scales.hpp converts from nondimensional numbers. A speed_of_file has its unit
// already: a conversion would round a bound.
enum class Dimension { label, number, force_over_weight, speed, speed_of_file, impulse, time, power, length };

constexpr const char* unit_of(Dimension dimension) {
    switch (dimension) {
        case Dimension::label:
            return "";  // has names instead
        case Dimension::number:
        case Dimension::force_over_weight:
            return "1";
        case Dimension::speed:
        case Dimension::speed_of_file:
            return "m/s";
        case Dimension::impulse:
            return "N s";
        case Dimension::time:
            return "s";
        case Dimension::power:
            return "W";
        case Dimension::length:
            return "m";
    }
    return "";
}

// What must be recorded of the motion for a quantity.
enum class Recorded {
    usual,         // what solving a cell records anyway
    impacts,       // each impact: trajectory::Detail::impacts for a rigid stop, otherwise ::contacts
    contacts,      // each stretch of motion: trajectory::Detail::contacts
    cycle_forces,  // the largest force of each cycle
};

// What a refined map assigns to a cell that it fills from the cells around it.
enum class Filled {
    never,         // belongs to the run towards the steady state, which a filled cell does not have
    as_around,     // the same as in all of them
    interpolated,  // where it is smooth
};

enum class StoredWhen {
    always,
    in_refined_maps,
    in_sweeps,
    of_many_starts,
    of_rigid_stops,
    of_certificates,
    of_certificates_of_rigid_stops,
    of_certified_attractors,
    of_certified_attractors_of_rigid_stops,
    of_uncertain_rigs,
    of_uncertain_rigs_with_forces,
    of_uncertain_rigs_on_rigid_stops,
    of_disturbed_cells,
    of_disturbed_attractors,
    on_request
};

// When a quantity is stored; if on request, the name that requests it.
struct StorageRule {
    StoredWhen kept = StoredWhen::always;
    std::optional<OptionalField> field = {};
    const char* field_name = nullptr;  // nullptr: the quantity's own name
    // Of an elasticity: the number by which it is one, as axes name it (job/axis_quantity.hpp), and the field
    // that requests it together with those by all other numbers that the job gives.
    const char* by_number = nullptr;
    std::optional<OptionalField> field_of_all = {};
    const char* name_of_all = nullptr;
};

inline constexpr int newest_layout = 3;  // of files

enum class InAttractorTable { no, yes };

enum class NumberKind { label, count, real };

// A number of a cell as a double, which represents every kind exactly.
template <class Numbers>
struct Access {
    double (*load)(const Numbers&);
    void (*store)(Numbers&, double);
};

template <template <Units> class Numbers>
struct Member {
    NumberKind kind;
    Access<Numbers<Units::nondimensional>> computed;
    Access<Numbers<Units::of_file>> stored;
};

// Numbers: Result, Attractor or Outcome.
template <template <Units> class Numbers>
struct QuantityOf {
    using Computed = Numbers<Units::nondimensional>;
    using Stored = Numbers<Units::of_file>;

    const char* name;  // of its dataset
    Member<Numbers> member;
    Dimension dimension;
    const char* words;
    StorageRule keeping = {};
    Filled filled = Filled::never;
    Recorded recorded = Recorded::usual;
    InAttractorTable in_attractor_table = InAttractorTable::no;
    std::span<const char* const> names_of_values = {};  // of a label
    int since = 2;                                      // the first file layout that has it
    int first_value = 0;                                // first value that has a name

    [[nodiscard]] double load(const Computed& from) const { return member.computed.load(from); }
    [[nodiscard]] double load(const Stored& from) const { return member.stored.load(from); }
    void store(Computed& to, double value) const { member.computed.store(to, value); }
    void store(Stored& to, double value) const { member.stored.store(to, value); }
};

using Quantity = QuantityOf<Result>;
using AttractorQuantity = QuantityOf<Attractor>;
using OutcomeQuantity = QuantityOf<Outcome>;

namespace table {

template <class Numbers, class Pick>
constexpr Access<Numbers> access_by() {
    return {[](const Numbers& from) { return static_cast<double>(Pick{}(from)); },
            [](Numbers& to, double value) {
                auto& member = Pick{}(to);
                member = static_cast<std::remove_reference_t<decltype(member)>>(value);
            }};
}

template <template <Units> class Numbers, class Pick>
constexpr Member<Numbers> member_of() {
    using Computed = Numbers<Units::nondimensional>;
    using Number = std::remove_cvref_t<std::invoke_result_t<Pick, const Computed&>>;
    constexpr NumberKind kind = std::is_same_v<Number, double>         ? NumberKind::real
                                : std::is_same_v<Number, std::int32_t> ? NumberKind::count
                                                                       : NumberKind::label;
    return {kind, access_by<Computed, Pick>(), access_by<Numbers<Units::of_file>, Pick>()};
}

template <class Pick>
constexpr Member<Result> member(Pick /*pick*/) {
    return member_of<Result, Pick>();
}

template <class Pick>
constexpr Member<Attractor> of_attractor(Pick /*pick*/) {
    return member_of<Attractor, Pick>();
}

template <class Pick>
constexpr Member<Outcome> of_outcome(Pick /*pick*/) {
    return member_of<Outcome, Pick>();
}

constexpr StorageRule asked_for(OptionalField field, const char* name = nullptr) {
    return {StoredWhen::on_request, field, name};
}

inline constexpr StorageRule always;
inline constexpr StorageRule in_refined_maps{StoredWhen::in_refined_maps};
inline constexpr StorageRule in_sweeps{StoredWhen::in_sweeps};
inline constexpr StorageRule of_many_starts{StoredWhen::of_many_starts};
inline constexpr StorageRule of_rigid_stops{StoredWhen::of_rigid_stops};
inline constexpr StorageRule of_certificates{StoredWhen::of_certificates};
inline constexpr StorageRule of_certificates_of_rigid_stops{StoredWhen::of_certificates_of_rigid_stops};
inline constexpr StorageRule of_their_attractors{StoredWhen::of_certified_attractors};
inline constexpr StorageRule of_their_attractors_on_rigid_stops{
    StoredWhen::of_certified_attractors_of_rigid_stops};
inline constexpr StorageRule of_uncertain_rigs{StoredWhen::of_uncertain_rigs};
inline constexpr StorageRule of_their_forces{StoredWhen::of_uncertain_rigs_with_forces};
inline constexpr StorageRule of_their_speeds{StoredWhen::of_uncertain_rigs_on_rigid_stops};
inline constexpr StorageRule of_disturbed_cells{StoredWhen::of_disturbed_cells};
inline constexpr StorageRule of_disturbed_attractors{StoredWhen::of_disturbed_attractors};
inline constexpr StorageRule of_kicks = asked_for(OptionalField::critical_kick, "critical_kick");
inline constexpr auto table_too = InAttractorTable::yes;
constexpr StorageRule force_by(OptionalField field, const char* number) {
    return {StoredWhen::on_request, field, nullptr, number, OptionalField::force_elasticity,
            "force_elasticity"};
}
constexpr StorageRule speed_by(OptionalField field, const char* number) {
    return {StoredWhen::on_request, field, nullptr, number, OptionalField::speed_elasticity,
            "speed_elasticity"};
}
template <std::size_t n>
inline constexpr Member<Result> elasticity = member([](auto& cell) -> auto& { return cell.elasticities[n]; });

using enum Filled;
using enum Recorded;
using enum Dimension;

inline constexpr const char* life_words =
    "mean life of a settled motion under the disturbances of [noise]: until it would no longer return without "
    "them";
inline constexpr const char* life_least_words =
    "where fewer than three lives were seen to end under [noise]: it lasts at least that long, roughly";
inline constexpr const char* kick_words =
    "smallest sudden change found of the settled hammer's velocity, at all forcing phases, after which it "
    "ends elsewhere";
inline constexpr const char* kick_phase_words =
    "when the critical kick acts, in forcing cycles after phase 0 of the orbit's first point, 0 to q";
inline constexpr const char* kick_tried_words =
    "up to which size kicks were tried at all phases: without a critical kick none was found up to this";
inline constexpr const char* kick_lower_words =
    "a verified lower bound of the critical kick: up to this size they lead back; NaN where none is known";
inline constexpr const char* kick_direction_words =
    "whether the critical kick is towards the stop (1) or away from it (-1); 0 where there is none";

inline constexpr const char* force_lower_words =
    "proved lower bound of the peak impact force over hammer weight, F/(m g0)";
inline constexpr const char* force_upper_words =
    "proved upper bound of the peak impact force over hammer weight, F/(m g0)";
inline constexpr const char* speed_lower_words =
    "proved lower bound of the largest speed of the hammer against the rigid stop";
inline constexpr const char* speed_upper_words =
    "proved upper bound of the largest speed of the hammer against the rigid stop";
inline constexpr const char* margin_words =
    "proved lower bound of min(1 - |det M|, 1 + det M - |tr M|), M being the orbit's monodromy matrix";

inline constexpr const char* force_words =
    "relative change of the orbit's peak impact force [N] per relative change of this number of the job";
inline constexpr const char* speed_words =
    "relative change of the orbit's largest impact speed [m/s] per relative change of this number of the job";

// clang-format off
inline constexpr Quantity rows[] = {
    {"regime", member([](auto& cell) -> auto& { return cell.regime; }), label, "regime of the steady state", always, as_around, usual, table_too, regime_names},
    {"status", member([](auto& cell) -> auto& { return cell.status; }), label, "why a cell is unresolved or failed, or what its claim leaves open", always, never, usual, {}, status_names},
    {"computed", member([](auto& cell) -> auto& { return cell.computed; }), label, "whether the cell is computed or filled from computed cells around it", in_refined_maps, never, usual, {}, computed_names},
    {"engine", member([](auto& cell) -> auto& { return cell.engine; }), label, "engine that carried the cell; exact leaves a cubic spring out", always, as_around, usual, {}, engine_names},
    {"impacts", member([](auto& cell) -> auto& { return cell.impacts; }), number, "impacts p of z = p/q", always, as_around, usual, table_too},
    {"period", member([](auto& cell) -> auto& { return cell.period; }), number, "period q of z = p/q in forcing cycles", always, as_around, usual, table_too},
    {"peak_force_ratio", member([](auto& cell) -> auto& { return cell.peak_force; }), force_over_weight, "peak impact force over hammer weight, F/(m g0)", always, interpolated, usual, table_too},
    {"jump", member([](auto& cell) -> auto& { return cell.jump; }), label, "whether the peak force, or on a rigid stop the impact speed, jumps on the way to this point from the one before it in the branch", in_sweeps, never, usual, {}, jump_names},
    {"chatter", member([](auto& cell) -> auto& { return cell.chatter; }), label, "whether impacts on the rigid stop accumulate to rest; each such chatter counts as one impact", of_rigid_stops, as_around, usual, {}, chatter_names},
    {"impact_rate", member([](auto& cell) -> auto& { return cell.impact_rate; }), number, "impacts per forcing cycle", always, interpolated},
    {"cycles", member([](auto& cell) -> auto& { return cell.cycles; }), number, "forcing cycles spent"},
    {"observed_cycles", member([](auto& cell) -> auto& { return cell.observed_cycles; }), number, "forcing cycles for which a chaotic or unresolved motion was followed"},
    {"multiplier", member([](auto& cell) -> auto& { return cell.multiplier; }), number, "largest absolute Floquet multiplier of the orbit", asked_for(OptionalField::multiplier), interpolated},
    {"lyapunov", member([](auto& cell) -> auto& { return cell.lyapunov; }), number, "largest Lyapunov exponent per forcing cycle", asked_for(OptionalField::lyapunov), interpolated},
    {"sensitivity", member([](auto& cell) -> auto& { return cell.sensitivity; }), number, "largest growth of an error that came in at any moment, ln G", asked_for(OptionalField::sensitivity)},
    {"orbit_displacement", member([](auto& cell) -> auto& { return cell.orbit_displacement; }), number, "orbit at forcing phase 0, (x - y)/A0", asked_for(OptionalField::orbit, "orbit"), interpolated, usual, table_too},
    {"orbit_velocity", member([](auto& cell) -> auto& { return cell.orbit_velocity; }), number, "orbit at forcing phase 0, (x' - y')/(A0 omega)", asked_for(OptionalField::orbit, "orbit"), interpolated, usual, table_too},
    {"impact_speed", member([](auto& cell) -> auto& { return cell.impact_speed; }), speed, "largest speed of the hammer against the stop at first touch", asked_for(OptionalField::impact_speed), interpolated, impacts},
    {"impulse", member([](auto& cell) -> auto& { return cell.impulse; }), impulse, "largest impulse of one impact", asked_for(OptionalField::impulse), interpolated, impacts},
    {"contact_time", member([](auto& cell) -> auto& { return cell.contact_time; }), time, "longest time for which the stop presses in one impact", asked_for(OptionalField::contact_time), interpolated, impacts},
    {"contact_power_w", member([](auto& cell) -> auto& { return cell.contact_power; }), power, "mean power that the impacts take from the hammer's motion against the cart", asked_for(OptionalField::contact_power), interpolated, impacts},
    {"max_displacement", member([](auto& cell) -> auto& { return cell.max_displacement; }), length, "largest displacement of the hammer from its rest in the cart, |x - y|", asked_for(OptionalField::max_displacement), interpolated, contacts},
    {"peak_force_mean_ratio", member([](auto& cell) -> auto& { return cell.peak_force_mean; }), force_over_weight, "mean of the largest impact force of each forcing cycle, F/(m g0)", asked_for(OptionalField::force_per_cycle, "force_per_cycle"), interpolated, cycle_forces},
    {"peak_force_q95_ratio", member([](auto& cell) -> auto& { return cell.peak_force_q95; }), force_over_weight, "95 % quantile of the largest impact force of each forcing cycle, F/(m g0)", asked_for(OptionalField::force_per_cycle, "force_per_cycle"), interpolated, cycle_forces},
    {"window_cycles", member([](auto& cell) -> auto& { return cell.window_cycles; }), number, "forcing cycles of which these are mean and quantile", asked_for(OptionalField::force_per_cycle, "force_per_cycle"), as_around, cycle_forces},
    {"last_impact", member([](auto& cell) -> auto& { return cell.last_impact; }), number, "forcing cycles until the last impact; none where impacts go on or the cell was filled", asked_for(OptionalField::last_impact)},
    {"critical_kick", member([](auto& cell) -> auto& { return cell.kick.size; }), speed, kick_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_phase", member([](auto& cell) -> auto& { return cell.kick.phase; }), number, kick_phase_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_tried", member([](auto& cell) -> auto& { return cell.kick.tried; }), speed, kick_tried_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_lower", member([](auto& cell) -> auto& { return cell.kick.lower; }), speed, kick_lower_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_direction", member([](auto& cell) -> auto& { return cell.kick.direction; }), label, kick_direction_words, of_kicks, never, usual, {}, {}, 3},
    {"force_elasticity_frequency_hz", elasticity<0>, number, force_words, force_by(OptionalField::force_by_frequency_hz, "frequency_hz"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_gap_m", elasticity<1>, number, force_words, force_by(OptionalField::force_by_gap_m, "gap_m"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_mass_kg", elasticity<2>, number, force_words, force_by(OptionalField::force_by_hammer_mass_kg, "hammer.mass_kg"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_natural_frequency_hz", elasticity<3>, number, force_words, force_by(OptionalField::force_by_hammer_natural_frequency_hz, "hammer.natural_frequency_hz"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_stiffness_n_per_m", elasticity<4>, number, force_words, force_by(OptionalField::force_by_hammer_stiffness_n_per_m, "hammer.stiffness_n_per_m"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_damping_ns_per_m", elasticity<5>, number, force_words, force_by(OptionalField::force_by_hammer_damping_ns_per_m, "hammer.damping_ns_per_m"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_damping_ratio", elasticity<6>, number, force_words, force_by(OptionalField::force_by_hammer_damping_ratio, "hammer.damping_ratio"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_hammer_cubic_stiffness_n_per_m3", elasticity<7>, number, force_words, force_by(OptionalField::force_by_hammer_cubic_stiffness_n_per_m3, "hammer.cubic_stiffness_n_per_m3"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_cart_amplitude_m", elasticity<8>, number, force_words, force_by(OptionalField::force_by_cart_amplitude_m, "cart.amplitude_m"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_contact_stiffness_n_per_m", elasticity<9>, number, force_words, force_by(OptionalField::force_by_contact_stiffness_n_per_m, "contact.stiffness_n_per_m"), interpolated, usual, {}, {}, 3},
    {"force_elasticity_contact_damping_ns_per_m", elasticity<10>, number, force_words, force_by(OptionalField::force_by_contact_damping_ns_per_m, "contact.damping_ns_per_m"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_frequency_hz", elasticity<0>, number, speed_words, speed_by(OptionalField::speed_by_frequency_hz, "frequency_hz"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_gap_m", elasticity<1>, number, speed_words, speed_by(OptionalField::speed_by_gap_m, "gap_m"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_mass_kg", elasticity<2>, number, speed_words, speed_by(OptionalField::speed_by_hammer_mass_kg, "hammer.mass_kg"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_natural_frequency_hz", elasticity<3>, number, speed_words, speed_by(OptionalField::speed_by_hammer_natural_frequency_hz, "hammer.natural_frequency_hz"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_stiffness_n_per_m", elasticity<4>, number, speed_words, speed_by(OptionalField::speed_by_hammer_stiffness_n_per_m, "hammer.stiffness_n_per_m"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_damping_ns_per_m", elasticity<5>, number, speed_words, speed_by(OptionalField::speed_by_hammer_damping_ns_per_m, "hammer.damping_ns_per_m"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_damping_ratio", elasticity<6>, number, speed_words, speed_by(OptionalField::speed_by_hammer_damping_ratio, "hammer.damping_ratio"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_hammer_cubic_stiffness_n_per_m3", elasticity<7>, number, speed_words, speed_by(OptionalField::speed_by_hammer_cubic_stiffness_n_per_m3, "hammer.cubic_stiffness_n_per_m3"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_cart_amplitude_m", elasticity<8>, number, speed_words, speed_by(OptionalField::speed_by_cart_amplitude_m, "cart.amplitude_m"), interpolated, usual, {}, {}, 3},
    {"speed_elasticity_contact_coefficient", elasticity<11>, number, speed_words, speed_by(OptionalField::speed_by_contact_coefficient, "contact.coefficient"), interpolated, usual, {}, {}, 3},
    {"certified", member([](auto& cell) -> auto& { return cell.certified; }), label, "what of the cell is proved in interval arithmetic, or why nothing is (negative)", of_certificates, never, usual, {}, certified_names, 3, first_certified},
    {"peak_force_lower_ratio", member([](auto& cell) -> auto& { return cell.force_lower; }), number, force_lower_words, of_certificates, never, usual, {}, {}, 3},
    {"peak_force_upper_ratio", member([](auto& cell) -> auto& { return cell.force_upper; }), number, force_upper_words, of_certificates, never, usual, {}, {}, 3},
    {"impact_speed_lower", member([](auto& cell) -> auto& { return cell.impact_speed_lower; }), speed_of_file, speed_lower_words, of_certificates_of_rigid_stops, never, usual, {}, {}, 3},
    {"impact_speed_upper", member([](auto& cell) -> auto& { return cell.impact_speed_upper; }), speed_of_file, speed_upper_words, of_certificates_of_rigid_stops, never, usual, {}, {}, 3},
    {"stability_margin", member([](auto& cell) -> auto& { return cell.stability_margin; }), number, margin_words, of_certificates, never, usual, {}, {}, 3},
    {"mean_life_s", member([](auto& cell) -> auto& { return cell.mean_life; }), time, life_words, of_disturbed_cells, never, usual, {}, {}, 3},
    {"mean_life_error_s", member([](auto& cell) -> auto& { return cell.mean_life_error; }), time, "standard error of the mean life", of_disturbed_cells, never, usual, {}, {}, 3},
    {"mean_life_least_s", member([](auto& cell) -> auto& { return cell.mean_life_least; }), time, life_least_words, of_disturbed_cells, never, usual, {}, {}, 3},
    {"attractors", member([](auto& cell) -> auto& { return cell.attractors; }), number, "attractors on which the starts of the cell end", of_many_starts},
    {"start_attractor", member([](auto& cell) -> auto& { return cell.start_attractor; }), number, "attractor on which [start] ends; -1 for none of those that are kept", of_many_starts},
    {"outcomes", member([](auto& cell) -> auto& { return cell.outcomes; }), number, "different outcomes of the rigs drawn for the cell", of_uncertain_rigs},
    {"outcome_others", member([](auto& cell) -> auto& { return cell.outcome_others; }), number, "probability of the outcomes beyond those that are kept", of_uncertain_rigs},
    {"force_q05_ratio", member([](auto& cell) -> auto& { return cell.drawn_q05; }), number, "5 % quantile of the peak impact force over the weight of the cell's own hammer, F/(m g0), over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_forces, interpolated},
    {"force_q50_ratio", member([](auto& cell) -> auto& { return cell.drawn_q50; }), number, "median of the peak impact force over the weight of the cell's own hammer, F/(m g0), over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_forces, interpolated},
    {"force_q95_ratio", member([](auto& cell) -> auto& { return cell.drawn_q95; }), number, "95 % quantile of the peak impact force over the weight of the cell's own hammer, F/(m g0), over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_forces, interpolated},
    {"speed_q05", member([](auto& cell) -> auto& { return cell.drawn_q05; }), speed_of_file, "5 % quantile of the largest speed of the hammer against the rigid stop, over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_speeds, interpolated},
    {"speed_q50", member([](auto& cell) -> auto& { return cell.drawn_q50; }), speed_of_file, "median of the largest speed of the hammer against the rigid stop, over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_speeds, interpolated},
    {"speed_q95", member([](auto& cell) -> auto& { return cell.drawn_q95; }), speed_of_file, "95 % quantile of the largest speed of the hammer against the rigid stop, over the rigs drawn; no impact counts as 0, as does a failed rig", of_their_speeds, interpolated},
};

// A share is filled by its own rule (refine/fill_attractors.cpp).
inline constexpr AttractorQuantity attractor_rows[] = {
    {"attractor_regime", of_attractor([](auto& attractor) -> auto& { return attractor.regime; }), label, "regime of an attractor of the cell, those with the largest shares first", always, as_around, usual, {}, regime_names},
    {"attractor_status", of_attractor([](auto& attractor) -> auto& { return attractor.status; }), label, "the status of the start whose claim leaves least open, of those that end on it", always, never, usual, {}, status_names, 3},
    {"attractor_impacts", of_attractor([](auto& attractor) -> auto& { return attractor.impacts; }), number, "impacts p of its z = p/q", always, as_around},
    {"attractor_period", of_attractor([](auto& attractor) -> auto& { return attractor.period; }), number, "period q of its z = p/q in forcing cycles", always, as_around},
    {"attractor_peak_force_ratio", of_attractor([](auto& attractor) -> auto& { return attractor.peak_force; }), force_over_weight, "its peak impact force over hammer weight, F/(m g0)", always, interpolated},
    {"basin_share", of_attractor([](auto& attractor) -> auto& { return attractor.share; }), number, "share of the cell's starts that end on it"},
    {"mean_life_s", of_attractor([](auto& attractor) -> auto& { return attractor.mean_life; }), time, "of chaos from which starts of the cell were seen to escape, and of settled motions under the disturbances of [noise]: its mean life", always, never, usual, {}, {}, 3},
    {"mean_life_error_s", of_attractor([](auto& attractor) -> auto& { return attractor.mean_life_error; }), time, "standard error of the mean life", always, never, usual, {}, {}, 3},
    {"mean_life_least_s", of_attractor([](auto& attractor) -> auto& { return attractor.mean_life_least; }), time, life_least_words, of_disturbed_attractors, never, usual, {}, {}, 3},
    {"critical_kick", of_attractor([](auto& attractor) -> auto& { return attractor.kick.size; }), speed, kick_words, of_kicks},
    {"critical_kick_phase", of_attractor([](auto& attractor) -> auto& { return attractor.kick.phase; }), number, kick_phase_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_tried", of_attractor([](auto& attractor) -> auto& { return attractor.kick.tried; }), speed, kick_tried_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_lower", of_attractor([](auto& attractor) -> auto& { return attractor.kick.lower; }), speed, kick_lower_words, of_kicks, never, usual, {}, {}, 3},
    {"critical_kick_direction", of_attractor([](auto& attractor) -> auto& { return attractor.kick.direction; }), label, kick_direction_words, of_kicks, never, usual, {}, {}, 3},
    {"attractor_orbit_displacement", of_attractor([](auto& attractor) -> auto& { return attractor.orbit_displacement; }), number, "its orbit's first point at forcing phase 0, (x - y)/A0", always, never, usual, {}, {}, 3},
    {"attractor_orbit_velocity", of_attractor([](auto& attractor) -> auto& { return attractor.orbit_velocity; }), number, "its orbit's first point at forcing phase 0, (x' - y')/(A0 omega)", always, never, usual, {}, {}, 3},
    {"attractor_certified", of_attractor([](auto& attractor) -> auto& { return attractor.certified; }), label, "what of the attractor is proved in interval arithmetic, or why nothing is (negative)", of_their_attractors, never, usual, {}, certified_names, 3, first_certified},
    {"attractor_peak_force_lower_ratio", of_attractor([](auto& attractor) -> auto& { return attractor.force_lower; }), number, force_lower_words, of_their_attractors, never, usual, {}, {}, 3},
    {"attractor_peak_force_upper_ratio", of_attractor([](auto& attractor) -> auto& { return attractor.force_upper; }), number, force_upper_words, of_their_attractors, never, usual, {}, {}, 3},
    {"attractor_impact_speed_lower", of_attractor([](auto& attractor) -> auto& { return attractor.impact_speed_lower; }), speed_of_file, speed_lower_words, of_their_attractors_on_rigid_stops, never, usual, {}, {}, 3},
    {"attractor_impact_speed_upper", of_attractor([](auto& attractor) -> auto& { return attractor.impact_speed_upper; }), speed_of_file, speed_upper_words, of_their_attractors_on_rigid_stops, never, usual, {}, {}, 3},
    {"attractor_stability_margin", of_attractor([](auto& attractor) -> auto& { return attractor.stability_margin; }), number, margin_words, of_their_attractors, never, usual, {}, {}, 3},
};

// A probability is filled by the rule of shares (refine/fill_attractors.cpp).
inline constexpr OutcomeQuantity outcome_rows[] = {
    {"outcome_regime", of_outcome([](auto& outcome) -> auto& { return outcome.regime; }), label, "regime of an outcome of the rigs drawn for the cell, the most likely first", always, as_around, usual, {}, regime_names},
    {"outcome_impacts", of_outcome([](auto& outcome) -> auto& { return outcome.impacts; }), number, "impacts p of its z = p/q", always, as_around},
    {"outcome_period", of_outcome([](auto& outcome) -> auto& { return outcome.period; }), number, "period q of its z = p/q in forcing cycles", always, as_around},
    {"outcome_probability", of_outcome([](auto& outcome) -> auto& { return outcome.probability; }), number, "share of the rigs drawn for the cell that end in it"},
};
// clang-format on

}  // namespace table

inline constexpr std::span<const Quantity> quantities = table::rows;
inline constexpr std::span<const AttractorQuantity> attractor_quantities = table::attractor_rows;
inline constexpr std::span<const OutcomeQuantity> outcome_quantities = table::outcome_rows;

// Whether a quantity tells of the rigs drawn for a cell.
constexpr bool is_of_uncertain_rigs(const Quantity& quantity) {
    return quantity.keeping.kept == StoredWhen::of_uncertain_rigs ||
           quantity.keeping.kept == StoredWhen::of_uncertain_rigs_with_forces ||
           quantity.keeping.kept == StoredWhen::of_uncertain_rigs_on_rigid_stops;
}

// Passes on the field of each quantity that is computed on request, with its name.
template <template <Units> class Numbers, class Take>
constexpr void for_each_field_of(std::span<const QuantityOf<Numbers>> rows, Take take) {
    for (const QuantityOf<Numbers>& quantity : rows) {
        const StorageRule& keeping = quantity.keeping;
        if (!keeping.field) continue;
        take(*keeping.field, keeping.field_name == nullptr ? quantity.name : keeping.field_name);
        if (keeping.field_of_all) take(*keeping.field_of_all, keeping.name_of_all);
    }
}

}  // namespace peterka::cell
