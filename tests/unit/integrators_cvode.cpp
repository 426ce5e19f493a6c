// CVODE, leg by leg.
#include <gtest/gtest.h>

#include "integrators/steppers.hpp"

namespace peterka::integrators {
namespace {

TEST(CvodeStepper, FailsWithoutAWordOfTheLibrary) {
    SundialsLeg leg{.oscillator = {.frequency = 2, .gap = 1, .cubic = 1}};
    for (const auto method : {CvodeStepper::Method::adams, CvodeStepper::Method::bdf}) {
        CvodeStepper stepper(leg, method);
        stepper.start({-1e150, 0}, 1, 0.1);  // its acceleration is beyond the largest number
        ::testing::internal::CaptureStderr();
        EXPECT_FALSE(stepper.step());
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    }
}

}  // namespace
}  // namespace peterka::integrators
