// The integrators and the tolerances that tests give them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <ostream>

#include "integrators/integrated_cycle_map.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::testing {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

inline constexpr std::array every_integrator{Integrator::cvode_adams, Integrator::cvode_bdf,
                                             Integrator::arkode_explicit, Integrator::arkode_implicit};
inline constexpr std::array every_tolerance{1e-4, 1e-6, 1e-9};

struct Setting {
    Integrator integrator;
    double tolerance;
};

// For the names of the tests' parameters.
inline void PrintTo(const Setting& setting, std::ostream* out) {
    constexpr std::array names{"cvode_adams", "cvode_bdf", "arkode_explicit", "arkode_implicit"};
    *out << names[static_cast<std::size_t>(setting.integrator)] << " at " << setting.tolerance;
}

inline ::testing::Message label(Integrator integrator, double tolerance) {
    return ::testing::Message() << ::testing::PrintToString(Setting{integrator, tolerance});
}

// Tests of these are in several files, and run with each setting.
class EveryIntegrator : public ::testing::TestWithParam<Setting> {
  protected:
    [[nodiscard]] static IntegratedCycleMap map(const scene::Oscillator<double>& oscillator) {
        return {oscillator, GetParam().integrator, GetParam().tolerance};
    }
    static double tolerance() { return GetParam().tolerance; }
    static bool is_implicit() {
        return GetParam().integrator == Integrator::cvode_bdf ||
               GetParam().integrator == Integrator::arkode_implicit;
    }
    // The error asked for, in a state that is this much more sensitive to errors on its way.
    static double allowed(const trajectory::Cycle<double>& expected) {
        return tolerance() * (1 + expected.end.norm()) * (1 + expected.jacobian.norm());
    }
};

}  // namespace peterka::testing
