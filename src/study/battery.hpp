// The battery of stiff and extreme scenes on which every engine is tested.
//
// Each scene is the job's rig except for what it changes. The contact keeps its damping ratio zeta_i = ci/(2
// sqrt(m ki)) if its stiffness changes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka::study {

struct BatteryScene {
    const char* name;
    std::optional<double> contact_stiffness_n_per_m = {};  // ki
    std::optional<double> contact_damping_ratio = {};      // zeta_i
    std::optional<double> damping_ratio = {};              // zeta
    double frequency_ratio = 2;                            // eta
    double gap_ratio = 0;                                  // gap/A0
    std::optional<double> gap_over_grazing = {};           // gap as a multiple of the amplitude without a stop
    double cubic = 0;                                      // k3 A0^2/k
    job::CubicForm cubic_form = job::CubicForm::relative;
    std::optional<double> restitution = {};                         // a rigid stop
    std::optional<scene::HuntCrossley<double>> hunt_crossley = {};  // nondimensional
    double displacement_ratio = 0;                                  // start, x(0)/A0
    double velocity_ratio = 0;                                      // start, x'(0)/(A0 omega)
};

[[nodiscard]] std::span<const BatteryScene> battery();
[[nodiscard]] std::span<const char* const> battery_names();

// The scene on the job's rig, and its start.
[[nodiscard]] scene::Cell cell_of(const BatteryScene& given, const job::Job& job);

}  // namespace peterka::study
