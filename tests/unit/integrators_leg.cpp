// The right-hand side that SUNDIALS calls.
#include "integrators/leg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "integrators/objects.hpp"

namespace peterka::integrators {
namespace {

TEST(LegSlope, StopsTheIntegrationWhereAnythingIsNotFinite) {
    const auto context = sundials_library::make_context();
    const auto unknowns = sundials_library::make_vector(leg_unknowns, context.get());
    const auto slope = sundials_library::make_vector(leg_unknowns, context.get());
    SundialsLeg leg{.oscillator = {.frequency = 2, .gap = 0.5, .cubic = 1}};
    const auto flag_at = [&](double position, double velocity) {
        store({.state = {position, velocity}}, unknowns.get());
        return leg_slope(0, unknowns.get(), slope.get(), &leg);
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double damping_ratio : {0.0, 0.1}) {
        leg.oscillator.damping_ratio = damping_ratio;
        EXPECT_EQ(flag_at(-1, 3), 0);
        EXPECT_LT(flag_at(-1e200, 3), 0);  // the cubic's force is beyond the largest number
        EXPECT_LT(flag_at(std::nan(""), 3), 0);
        EXPECT_LT(flag_at(-1, infinite), 0);
        EXPECT_LT(flag_at(-1, -infinite), 0);
        EXPECT_LT(flag_at(-1, std::nan("")), 0);
    }
}

}  // namespace
}  // namespace peterka::integrators
