// CVODE and ARKODE against the closed form.
#include "integrators/integrated_cycle_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "integrator_settings.hpp"
#include "observed.hpp"
#include "rig.hpp"
#include "support/errors.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/lasting_contact.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using testing::beam_170mm;
using testing::EveryIntegrator;
using testing::observed;
using testing::paper_rig;
using testing::Setting;
using testing::start_at;
using Outcome = Cycle<double>::Outcome;

INSTANTIATE_TEST_SUITE_P(
    Tolerances, EveryIntegrator,
    ::testing::Values(Setting{Integrator::cvode_adams, 1e-4}, Setting{Integrator::cvode_adams, 1e-6},
                      Setting{Integrator::cvode_adams, 1e-9}, Setting{Integrator::cvode_bdf, 1e-4},
                      Setting{Integrator::cvode_bdf, 1e-6}, Setting{Integrator::cvode_bdf, 1e-9},
                      Setting{Integrator::arkode_explicit, 1e-4}, Setting{Integrator::arkode_explicit, 1e-6},
                      Setting{Integrator::arkode_explicit, 1e-9}, Setting{Integrator::arkode_implicit, 1e-4},
                      Setting{Integrator::arkode_implicit, 1e-6}, Setting{Integrator::arkode_implicit, 1e-9}));

// Cases that only an implicit method can follow in a reasonable number of steps.
class ImplicitIntegrator : public EveryIntegrator {};

INSTANTIATE_TEST_SUITE_P(
    Tolerances, ImplicitIntegrator,
    ::testing::Values(Setting{Integrator::cvode_bdf, 1e-4}, Setting{Integrator::cvode_bdf, 1e-6},
                      Setting{Integrator::cvode_bdf, 1e-9}, Setting{Integrator::arkode_implicit, 1e-4},
                      Setting{Integrator::arkode_implicit, 1e-6}, Setting{Integrator::arkode_implicit, 1e-9}));

void expect_agreement(const Cycle<double>& cycle, const Cycle<double>& expected, double allowed) {
    ASSERT_EQ(cycle.outcome, Outcome::done);
    EXPECT_EQ(cycle.impacts, expected.impacts);
    EXPECT_EQ(cycle.touched, expected.touched);
    EXPECT_EQ(cycle.separated, expected.separated);
    EXPECT_LT((cycle.end - expected.end).norm(), allowed);
    EXPECT_LT((cycle.jacobian - expected.jacobian).norm(), 10 * allowed * (1 + expected.jacobian.norm()));
}

TEST_P(EveryIntegrator, AgreesWithTheClosedFormFromRandomStarts) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> frequency(0.6, 4.0);
    std::uniform_real_distribution<double> gap(-0.5, 2);
    std::uniform_real_distribution<double> speed(-3, 3);
    int impacts = 0;
    for (int n = 0; n < 40; ++n) {
        SCOPED_TRACE(n);
        auto oscillator = paper_rig(beam_170mm, frequency(random), gap(random));
        if (n % 5 == 1) oscillator.kelvin_voigt().damping *= 4;  // an overdamped stop
        if (n % 5 == 2) oscillator.kelvin_voigt().damping = 0;   // an elastic one
        if (n % 5 == 3) oscillator.damping_ratio = 0.4;
        if (n % 5 == 4) oscillator.kelvin_voigt().stiffness = 3;  // a soft one
        const State<double> start(speed(random) - oscillator.gap, speed(random));
        const auto expected = observed(ExactCycleMap<double>(oscillator), start);
        const auto cycle = observed(map(oscillator), start);
        expect_agreement(cycle, expected, 3 * allowed(expected));
        EXPECT_NEAR(cycle.peak_force, expected.peak_force, 5 * tolerance() * expected.peak_force);
        EXPECT_GT(cycle.largest_displacement, (cycle.end[0] + oscillator.gap) * (1 - tolerance()));
        EXPECT_LT(cycle.largest_displacement, expected.largest_displacement * (1 + 1e-2));
        impacts += cycle.impacts;
    }
    EXPECT_GT(impacts, 30);
}

// Three impacts in two cycles; engines that detect events only at step ends miss one of the hops.
TEST_P(EveryIntegrator, MissesNoHopAtGapZero) {
    auto engine = map(paper_rig(beam_170mm, 3.1, 0));
    State<double> x = start_at(engine.oscillator());
    for (int n = 0; n < 200; ++n) x = engine(x).end;
    double peak_force = 0;
    for (int n = 0; n < 10; ++n) {
        int impacts = 0;
        for (int cycle = 0; cycle < 2; ++cycle) {
            const auto result = observed(engine, x);
            x = result.end;
            impacts += result.impacts;
            peak_force = std::max(peak_force, result.peak_force);
        }
        EXPECT_EQ(impacts, 3);
    }
    // row of tests/data/cells.csv, in units of the hammer's weight
    constexpr double weight = 0.298 * 9.80665;
    constexpr double unit_force = 238.23251103349492 * 0.89e-3;
    EXPECT_NEAR(peak_force * unit_force / weight, 24.4931763215696, 2 * tolerance() * 24.5);
}

// A hammer that rises past the stop by ten times the tolerance, for a time much shorter than a step, touches
// it; one that stays below by the same amount does not.
TEST_P(EveryIntegrator, SeesTouchesMuchShorterThanItsSteps) {
    auto oscillator = paper_rig(beam_170mm, 1.6, 0);
    const auto touches = [&](auto&& engine, double gap) {
        return engine(State<double>(-1 - gap, 0.5)).impacts > 0;
    };
    const auto exact = [&](double gap) {
        oscillator.gap = gap;
        return touches(ExactCycleMap<double>(oscillator), gap);
    };
    double low = 0;
    double high = 20;
    ASSERT_TRUE(exact(low));
    ASSERT_FALSE(exact(high));
    for (int n = 0; n < 50; ++n) (exact((low + high) / 2) ? low : high) = (low + high) / 2;
    for (const double margin : {10 * tolerance(), 1e-3}) {
        oscillator.gap = low - margin;
        EXPECT_TRUE(touches(map(oscillator), oscillator.gap)) << margin;
        oscillator.gap = low + margin;
        EXPECT_FALSE(touches(map(oscillator), oscillator.gap)) << margin;
    }
}

// ki, ci from soft to far stiffer than steel; stiff cases are left to the implicit methods.
TEST_P(EveryIntegrator, HandlesStopsFromSoftToRigid) {
    for (const double stiffness : {1.0, 1e4, 1e8, 1e12}) {
        for (const double damping_ratio : {0.0, 0.1, 1.0, 100.0}) {
            const bool stiff = damping_ratio * damping_ratio * stiffness > 1e10;
            if (stiff && !is_implicit()) continue;
            auto oscillator = paper_rig(beam_170mm, 2.0, 0.5);
            oscillator.kelvin_voigt().stiffness = stiffness;
            oscillator.kelvin_voigt().damping = 2 * damping_ratio * std::sqrt(stiffness);
            SCOPED_TRACE(::testing::Message() << "stiffness " << stiffness << " damping " << damping_ratio);
            const State<double> start(-1, 2);
            const auto expected = observed(ExactCycleMap<double>(oscillator), start);
            const auto cycle = observed(map(oscillator), start);
            expect_agreement(cycle, expected, 10 * allowed(expected));
            EXPECT_NEAR(cycle.peak_force, expected.peak_force, 10 * tolerance() * expected.peak_force);
        }
    }
}

// Overdamped stops: contacts that creep, last long, and separate where forces of 1e6 cancel.
TEST_P(ImplicitIntegrator, FollowsCreepingContacts) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 8; ++n) {
        SCOPED_TRACE(n);
        const double stiffness = std::pow(10, 6 + 6 * unit(random));
        const double damping_ratio = std::pow(10, 0.5 + 1.5 * unit(random));
        const Oscillator<double> oscillator{
            .damping_ratio = 0.2 * unit(random),
            .contact = scene::KelvinVoigt<double>{stiffness, 2 * damping_ratio * std::sqrt(stiffness)},
            .frequency = 0.3 + 2.7 * unit(random),
            .gap = -2 + 3 * unit(random)};
        const State<double> start(-1 - oscillator.gap, 1);
        const auto expected = observed(ExactCycleMap<double>(oscillator), start);
        const auto cycle = observed(map(oscillator), start);
        expect_agreement(cycle, expected, 3 * allowed(expected));
        EXPECT_NEAR(cycle.peak_force, expected.peak_force, 10 * tolerance() * expected.peak_force);
    }
}

TEST_P(EveryIntegrator, PressesForEverUnderPreload) {
    auto oscillator = paper_rig(beam_170mm, 0.3, -2.0);
    if (is_implicit()) {
        oscillator.kelvin_voigt().stiffness = 1e10;
        oscillator.kelvin_voigt().damping = 2 * 100 * 1e5;
    }
    const State<double> start = LinearContact<double>(oscillator).steady();
    const auto expected = observed(ExactCycleMap<double>(oscillator), start);
    ASSERT_FALSE(expected.separated);
    const auto cycle = observed(map(oscillator), start);
    expect_agreement(cycle, expected, allowed(expected));
    EXPECT_NEAR(cycle.peak_force, expected.peak_force, 5 * tolerance() * expected.peak_force);
}

TEST_P(EveryIntegrator, TellsOfWhatItCannotIntegrate) {
    ::testing::internal::CaptureStderr();
    auto engine = map(paper_rig(beam_170mm, 2, 0));
    EXPECT_EQ(engine({std::nan(""), 0}).outcome, Outcome::not_finite);
    EXPECT_EQ(engine({-1, INFINITY}).outcome, Outcome::not_finite);
    // a softening spring beyond its unstable equilibrium throws the hammer to infinity within the cycle
    Oscillator<double> softening{.frequency = 2, .gap = 1000, .cubic = -1};
    EXPECT_NE(map(softening)({-1010, -5}).outcome, Outcome::done);
    // a force beyond the largest double: the library fails, and its message must not reach the user
    const Oscillator<double> overflowing{.frequency = 2, .gap = 1, .cubic = 1};
    EXPECT_EQ(map(overflowing)({-1e150, 0}).outcome, Outcome::solver_failed);
    // ten million oscillations of an elastic stop in one cycle
    if (tolerance() == 1e-4) {
        Oscillator<double> ringing{.contact = scene::KelvinVoigt<double>{1e14, 0}, .frequency = 1, .gap = -10};
        EXPECT_EQ(map(ringing)({1.5e-13, 0}).outcome, Outcome::solver_failed);
    }
    EXPECT_EQ(engine(start_at(engine.oscillator())).outcome, Outcome::done);  // and it remains usable
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(IntegratedCycleMap, RefusesAToleranceThatItCannotHold) {
    const auto oscillator = paper_rig(beam_170mm, 2, 0);
    for (const double tolerance : {0.0, -1e-6, 1e-13, 1.0, std::nan("")}) {
        EXPECT_THROW(IntegratedCycleMap(oscillator, Integrator::cvode_adams, tolerance), Failure) << tolerance;
    }
}

TEST(IntegratedCycleMap, GoesOnAfterItIsMoved) {
    const auto oscillator = paper_rig(beam_170mm, 2, 0);
    for (const auto integrator : {Integrator::cvode_adams, Integrator::cvode_bdf, Integrator::arkode_explicit,
                                  Integrator::arkode_implicit}) {
        IntegratedCycleMap first(oscillator, integrator, 1e-6);
        const State<double> end = first({-5, -2.7}).end;
        IntegratedCycleMap second(std::move(first));
        EXPECT_EQ(second({-5, -2.7}).end, end);
        EXPECT_EQ(second.oscillator().frequency, 2);
    }
}

}  // namespace
}  // namespace peterka::trajectory
