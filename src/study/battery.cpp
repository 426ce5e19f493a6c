#include "study/battery.hpp"

#include <array>
#include <cmath>

namespace peterka::study {

namespace {

using job::CubicForm;
using HuntCrossley = scene::HuntCrossley<double>;

// clang-format off
constexpr std::array scenes{
    // from a stop as soft as the springs to one like granite
    BatteryScene{.name = "stiffness_1e2",  .contact_stiffness_n_per_m = 1e2},
    BatteryScene{.name = "stiffness_1e3",  .contact_stiffness_n_per_m = 1e3},
    BatteryScene{.name = "stiffness_1e4",  .contact_stiffness_n_per_m = 1e4},
    BatteryScene{.name = "stiffness_1e6",  .contact_stiffness_n_per_m = 1e6},
    BatteryScene{.name = "stiffness_1e8",  .contact_stiffness_n_per_m = 1e8},
    BatteryScene{.name = "stiffness_1e10", .contact_stiffness_n_per_m = 1e10},
    BatteryScene{.name = "stiffness_1e12", .contact_stiffness_n_per_m = 1e12},
    BatteryScene{.name = "stiffness_1e15", .contact_stiffness_n_per_m = 1e15},
    // contacts from elastic to a hundred times overdamped
    BatteryScene{.name = "contact_elastic",           .contact_damping_ratio = 0},
    BatteryScene{.name = "contact_almost_elastic",    .contact_damping_ratio = 0.01},
    BatteryScene{.name = "contact_critically_damped", .contact_damping_ratio = 1},
    BatteryScene{.name = "contact_overdamped",        .contact_damping_ratio = 3},
    BatteryScene{.name = "contact_overdamped_100",    .contact_damping_ratio = 100},
    BatteryScene{.name = "stiff_and_overdamped",      .contact_stiffness_n_per_m = 1e12, .contact_damping_ratio = 100},
    // undamped and heavily damped springs
    BatteryScene{.name = "springs_undamped",          .damping_ratio = 0},
    BatteryScene{.name = "springs_almost_critical",   .damping_ratio = 0.9},
    BatteryScene{.name = "springs_overdamped",        .damping_ratio = 3},
    // excitation from far below the natural frequency to far above
    BatteryScene{.name = "frequency_0_01",            .frequency_ratio = 0.01},
    BatteryScene{.name = "frequency_0_1",             .frequency_ratio = 0.1},
    BatteryScene{.name = "frequency_0_5",             .frequency_ratio = 0.5},
    BatteryScene{.name = "frequency_10",              .frequency_ratio = 10},
    BatteryScene{.name = "frequency_50",              .frequency_ratio = 50},
    BatteryScene{.name = "resonance",                 .frequency_ratio = 1, .gap_ratio = 5},
    BatteryScene{.name = "undamped_resonance",        .damping_ratio = 0, .frequency_ratio = 1, .gap_ratio = 5},
    // amplitudes grow without bound, and the stop is far
    BatteryScene{.name = "secular_growth",            .damping_ratio = 0, .frequency_ratio = 1, .gap_ratio = 1e6},
    // nothing dissipates, so nothing settles
    BatteryScene{.name = "conservative",              .contact_damping_ratio = 0, .damping_ratio = 0, .gap_ratio = 0.5},
    BatteryScene{.name = "conservative_free",         .contact_damping_ratio = 0, .damping_ratio = 0, .frequency_ratio = 2.3, .gap_ratio = 10},
    // gaps
    BatteryScene{.name = "gap_0_grazing_start",       .displacement_ratio = 0, .velocity_ratio = 2},
    BatteryScene{.name = "gap_negative",              .gap_ratio = -1},
    BatteryScene{.name = "gap_pressed_for_ever",      .frequency_ratio = 0.5, .gap_ratio = -5},
    BatteryScene{.name = "gap_hardly_out_of_reach",   .gap_over_grazing = 1 + 1e-6},
    BatteryScene{.name = "gap_hardly_in_reach",       .gap_over_grazing = 1 - 1e-6},
    BatteryScene{.name = "gap_at_rounding_out_of_reach", .gap_over_grazing = 1 + 1e-12},
    BatteryScene{.name = "gap_at_rounding_in_reach",  .gap_over_grazing = 1 - 1e-12},
    BatteryScene{.name = "gap_at_rest_out_of_reach",  .gap_over_grazing = 1 + 1e-9, .displacement_ratio = -4. / 3, .velocity_ratio = 0},
    // starts
    BatteryScene{.name = "start_far_away",            .gap_ratio = 0.5, .displacement_ratio = -1e3},
    BatteryScene{.name = "start_out_of_sight",        .gap_ratio = 0.5, .displacement_ratio = -1e6},
    BatteryScene{.name = "start_in_contact",          .gap_ratio = 0.5, .displacement_ratio = 0.51},
    BatteryScene{.name = "start_deep_in_contact",     .gap_ratio = 0.5, .displacement_ratio = 5},
    BatteryScene{.name = "start_very_fast",           .gap_ratio = 0.5, .velocity_ratio = 1e5},
    // springs with a cubic part
    BatteryScene{.name = "cubic_tiny",                .cubic = 1e-9},
    BatteryScene{.name = "cubic_of_the_paper",        .cubic = 7.921e-7},
    BatteryScene{.name = "cubic_weak_absolute",       .gap_ratio = 0.5, .cubic = 1e-6, .cubic_form = CubicForm::absolute},
    BatteryScene{.name = "cubic_strong",              .damping_ratio = 0.05, .cubic = 0.1},
    BatteryScene{.name = "cubic_dominating",          .damping_ratio = 0.05, .gap_ratio = 0.5, .cubic = 10},
    BatteryScene{.name = "cubic_softening",           .gap_ratio = 0.5, .cubic = -1e-3},
    BatteryScene{.name = "cubic_gives_way",           .gap_ratio = 1e3, .cubic = -0.05, .displacement_ratio = -10},
    // irregular motion
    BatteryScene{.name = "chaos",                     .frequency_ratio = 2.4, .gap_ratio = 1},
    // rigid stops
    BatteryScene{.name = "rigid",                     .damping_ratio = 0.02, .restitution = 0.6, .displacement_ratio = -1},
    BatteryScene{.name = "rigid_without_rebound",     .damping_ratio = 0.02, .gap_ratio = 0.5, .restitution = 0},
    BatteryScene{.name = "rigid_chatter",             .damping_ratio = 0.02, .frequency_ratio = 0.3, .restitution = 0.6, .displacement_ratio = -1},
    BatteryScene{.name = "rigid_close_to_elastic",    .damping_ratio = 0.02, .gap_ratio = 0.5, .restitution = 0.99},
    BatteryScene{.name = "rigid_elastic",             .damping_ratio = 0.05, .gap_ratio = 0.5, .restitution = 1},
    BatteryScene{.name = "rigid_conservative",        .damping_ratio = 0, .gap_ratio = 0.5, .restitution = 1},
    BatteryScene{.name = "rigid_pressed_for_ever",    .damping_ratio = 0.02, .frequency_ratio = 0.5, .gap_ratio = -5, .restitution = 0.6, .displacement_ratio = -6},
    // stops whose stiffness grows with the penetration
    BatteryScene{.name = "hunt_crossley_hertz",       .damping_ratio = 0.02, .hunt_crossley = HuntCrossley{1e4, 1.5, 0.1}},
    BatteryScene{.name = "hunt_crossley_stiff",       .damping_ratio = 0.02, .gap_ratio = 0.5, .hunt_crossley = HuntCrossley{1e9, 1.5, 0.1}},
    BatteryScene{.name = "hunt_crossley_linear",      .damping_ratio = 0.02, .gap_ratio = 0.5, .hunt_crossley = HuntCrossley{1e4, 1, 0.1}},
    BatteryScene{.name = "hunt_crossley_steep",       .damping_ratio = 0.02, .gap_ratio = 0.5, .hunt_crossley = HuntCrossley{1e6, 3, 0.2}},
};
// clang-format on

constexpr auto names = [] {
    std::array<const char*, scenes.size()> all{};
    for (std::size_t n = 0; n < scenes.size(); ++n) all[n] = scenes[n].name;
    return all;
}();

}  // namespace

std::span<const BatteryScene> battery() {
    return scenes;
}

std::span<const char* const> battery_names() {
    return names;
}

scene::Cell cell_of(const BatteryScene& given, const job::Job& job) {
    scene::Oscillator<double> rig = scene::oscillator_of(job);
    const scene::Scales scales = scene::scales_of(job);
    if (given.damping_ratio) rig.damping_ratio = *given.damping_ratio;
    rig.frequency = given.frequency_ratio;
    rig.cubic = given.cubic;
    rig.cubic_form = given.cubic_form;
    rig.gap = given.gap_ratio;
    if (given.gap_over_grazing) {
        const double eta = rig.frequency;
        rig.gap = *given.gap_over_grazing * eta * eta / std::hypot(1 - eta * eta, 2 * rig.damping_ratio * eta);
    }
    if (given.restitution) {
        rig.contact = scene::Restitution<double>{*given.restitution};
    } else if (given.hunt_crossley) {
        rig.contact = *given.hunt_crossley;
    } else {
        auto& stop = rig.kelvin_voigt();
        const double of_rig = stop.damping / (2 * std::sqrt(stop.stiffness));
        const double damping_ratio = given.contact_damping_ratio.value_or(of_rig);
        const double springs = scales.force_n / scales.length_m;  // k [N/m]
        if (given.contact_stiffness_n_per_m) stop.stiffness = *given.contact_stiffness_n_per_m / springs;
        stop.damping = 2 * damping_ratio * std::sqrt(stop.stiffness);
    }
    return {rig, {given.displacement_ratio - rig.gap, given.velocity_ratio - rig.frequency}};
}

}  // namespace peterka::study
