// The nondimensional numbers of a rig: the only place where they are derived from SI units.
//
// omega = sqrt(k/m), zeta = c/(2 m omega); for the stop kappa = ki/k, chi = ci/(m omega), or K A0^(n-1)/k, D A0
// omega.
#pragma once

#include "job/job.hpp"

namespace peterka::job {

struct HammerNumbers {
    double omega_rad_per_s = 0;
    double zeta = 0;
};

struct KelvinVoigtNumbers {
    double kappa = 0;
    double chi = 0;
};

struct HuntCrossleyNumbers {
    double stiffness = 0;    // K A0^(n-1)/k
    double dissipation = 0;  // D A0 omega
};

[[nodiscard]] HammerNumbers derive(const Hammer& hammer);
[[nodiscard]] double natural_frequency_hz(const Hammer& hammer);
[[nodiscard]] KelvinVoigtNumbers derive(const KelvinVoigt& stop, const Hammer& hammer);
[[nodiscard]] HuntCrossleyNumbers derive(const HuntCrossley& stop, const Hammer& hammer, const Cart& cart);

// Cycles that a trace shows: forcing cycles or, with a cart at rest, natural periods of the hammer.
[[nodiscard]] double cycles_shown(const Job& job);

}  // namespace peterka::job
