#include "noise/flight_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random_numbers.hpp"

namespace peterka::noise {
namespace {

using State = scene::State<double>;

constexpr int changes = 16;

// Of flights from the stop's vicinity: some rise above it only between the ends of a stretch. Each is compared
// with the closed form at a thousand times.
TEST(FlightSteps, AreTheClosedFormAndMissNoTouch) {
    const Stretches stretches(changes);
    RandomNumbers random(3);
    int touching = 0;
    int hidden = 0;
    int proved = 0;
    for (int n = 0; n < 3000; ++n) {
        const scene::Oscillator<double> oscillator{.damping_ratio = 0.5 * random.uniform() * random.uniform(),
                                                   .frequency = 0.5 + 4 * random.uniform(),
                                                   .gap = 3 * random.uniform() - 0.5};
        const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
        if (!FlightSteps::suits(flight)) continue;
        const FlightSteps steps(flight, oscillator.period(), stretches);
        const auto stretch = static_cast<std::size_t>(random.below(changes + 1));
        const double begin = oscillator.period() * stretches.ends[stretch];
        const double length = oscillator.period() * stretches.ends[stretch + 1] - begin;
        // some come near the stop about half-way
        const bool turns = random.uniform() < 0.5;
        const double room = std::pow(10, -4 * random.uniform());
        const double fall = std::abs(random.normal());
        const State start = turns ? State(-room - fall * length / 4, fall) : State(-room, 2 * random.normal());
        const motion::Leg<double> leg(flight, start, oscillator.frequency * begin);
        double highest = start[0];
        for (int i = 1; i <= 1000; ++i) highest = std::max(highest, leg.at(i * length / 1000).state[0]);
        const State expected = leg.at(length).state;
        const auto end = steps.end_of(stretch, start);
        touching += highest >= 0 ? 1 : 0;
        hidden += highest >= 0 && expected[0] < 0 ? 1 : 0;
        proved += end ? 1 : 0;
        if (!end) continue;
        EXPECT_LT(highest, 0);
        EXPECT_NEAR((*end)[0], expected[0], 1e-12 * (1 + start.norm()));
        EXPECT_NEAR((*end)[1], expected[1], 1e-12 * (1 + start.norm()));
    }
    EXPECT_GT(touching, 500);
    EXPECT_GT(hidden, 50);
    EXPECT_GT(proved, 500);
}

// At rest at both ends of a stretch about which the forcing is even, so equally far from the stop, but not
// between: the cubic with the same ends is constant, and only the fourth derivative tells.
TEST(FlightSteps, AreAboveTheCubicByTheFourthDerivative) {
    const Stretches stretches(changes);
    int rising = 0;
    for (const std::size_t stretch : {4, 12}) {
        for (const double frequency : {1.3, 2.0, 4.5}) {
            scene::Oscillator<double> oscillator{.frequency = frequency};
            const double length = oscillator.period() / changes;
            const motion::LinearMotion<double> about_stop(motion::flight_equation(oscillator));
            const scene::Jacobian<double> flow = about_stop.flow(length);
            const State steady = about_stop.steady(stretches.sine[stretch], stretches.cosine[stretch]);
            const State steady_end =
                about_stop.steady(stretches.sine[stretch + 1], stretches.cosine[stretch + 1]);
            const State start(steady[0] + (flow(1, 1) * steady[1] - steady_end[1]) / flow(1, 0), 0);
            const motion::Leg<double> leg(about_stop, start, 2 * std::numbers::pi * stretches.ends[stretch]);
            const double rise = leg.at(length / 2).state[0] - start[0];
            ASSERT_NEAR(leg.at(length).state[0], start[0], 1e-12);
            ASSERT_NEAR(leg.at(length).state[1], 0, 1e-12);
            if (rise <= 0) continue;
            ++rising;
            for (const bool touches : {true, false}) {
                const double room = touches ? 0.9 * rise : 20 * rise;
                oscillator.gap = start[0] + room;
                const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
                const FlightSteps steps(flight, oscillator.period(), stretches);
                EXPECT_EQ(steps.end_of(stretch, {-room, 0}).has_value(), !touches) << frequency << " " << rise;
            }
        }
    }
    EXPECT_EQ(rising, 3);
}

// The proof needs little room: of a swing below the stop at all times, it leaves hardly a stretch to the
// engine.
TEST(FlightSteps, LeaveLittleToTheEngine) {
    const scene::Oscillator<double> oscillator{.damping_ratio = 0.02, .frequency = 1.5, .gap = 2};
    const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
    const FlightSteps steps(flight, oscillator.period(), Stretches(changes));
    State state = flight.steady(0, 1) + State(flight.rest(), 0);
    for (std::size_t n = 0; n <= changes; ++n) {
        const auto end = steps.end_of(n, state);
        ASSERT_TRUE(end) << n;
        state = *end;
    }
    EXPECT_NEAR(state[0], flight.steady(0, 1)[0] + flight.rest(), 1e-13);
    EXPECT_GT(std::abs(flight.response()), 1.75);  // of a gap of 2
}

}  // namespace
}  // namespace peterka::noise
