// The quantities whose rise the kernel watches along a flight.
#include <gtest/gtest.h>

#include "batch_one_cell.hpp"

namespace peterka::testing {
namespace {

// Each derivative of the force is that of the one before, by central differences along the flight.
TEST(BatchFlight, TellsTheDerivativesOfTheForceThatTheStopWouldExert) {
    const OneCell cell(
        {.damping_ratio = 0.1, .contact = scene::KelvinVoigt<double>{40, 8}, .frequency = 2.5, .gap = 0.3}, 16);
    const lanes::Moments start = moments({-0.7, 1.3}, 0.9);
    const lanes::Flight flight(cell, start);
    const auto rise_at = [&](double t) {
        const lanes::Moments m = flight.at(lanes::all(t));
        return lanes::rise_of_force(cell, m, lanes::derivatives(cell, m));
    };
    constexpr double h = 1e-4;
    for (const double t : {0.1, 0.6, 1.7}) {
        const lanes::Rise before = rise_at(t - h);
        const lanes::Rise now = rise_at(t);
        const lanes::Rise after = rise_at(t + h);
        const auto difference = [&](lanes::V lanes::Rise::*of) {
            return (one_of(after.*of) - one_of(before.*of)) / (2 * h);
        };
        EXPECT_NEAR(one_of(now.slope), difference(&lanes::Rise::value), 1e-6);
        EXPECT_NEAR(one_of(now.second), difference(&lanes::Rise::slope), 1e-6);
        EXPECT_NEAR(one_of(now.third), difference(&lanes::Rise::second), 1e-6);
        EXPECT_NEAR(one_of(now.fourth), difference(&lanes::Rise::third), 1e-6);
        const lanes::Moments m = flight.at(lanes::all(t));
        EXPECT_NEAR(one_of(now.value), one_of(m.delta) + 8.0 / 40 * one_of(m.velocity), 1e-14);
    }
}

}  // namespace
}  // namespace peterka::testing
