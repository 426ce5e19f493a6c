// Proofs for cells, against the engine, which shares no code with them.
#include "certificate/certify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "certified_cells.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;

double force_of(const SolvedPlace& place) {
    return place.cell.peak_force * scene::scales_of(place.numbers).force_ratio();
}

// The multipliers are not stored; only in flight does their product follow from
// the dissipation alone. The margin is therefore compared with the largest of
// them: 1 + det - |tr| = (1 - |m1|)(1 - |m2|) for real ones of equal sign.
TEST(Certify, MostOrbitsOfAPlaneAreProved) {
    const auto cells = testing::cells_of(regime::Regime::periodic, 30);
    ASSERT_GT(cells.size(), 250U);
    std::map<Certified, std::size_t> verdicts;
    for (const SolvedPlace& place : cells) {
        const Certificate certificate = certify(place.numbers, claim_of(place.cell));
        ++verdicts[certificate.verdict];
        if (!certificate.proved()) continue;
        const double force = force_of(place);
        EXPECT_LT(certificate.force_ratio.lo, force * (1 + 1e-9));
        EXPECT_GT(certificate.force_ratio.hi, force * (1 - 1e-9));
        EXPECT_LT(certificate.force_ratio.hi / certificate.force_ratio.lo - 1, 1e-7);
        EXPECT_GT(certificate.stability_margin, 0);
        EXPECT_LE(certificate.stability_margin, 2 * (1 - place.cell.multiplier) + 1e-9);
    }
    EXPECT_EQ(verdicts[Certified::orbit] + verdicts[Certified::no_orbit_found], cells.size());
    EXPECT_LE(verdicts[Certified::no_orbit_found], cells.size() / 100);
}

TEST(Certify, NoImpactIsProvedFromTheStart) {
    const auto cells = testing::cells_of(regime::Regime::no_impact, 12);
    ASSERT_GT(cells.size(), 50U);
    std::size_t from_start = 0;
    for (const SolvedPlace& place : cells) {
        const Certificate certificate = certify(place.numbers, claim_of(place.cell));
        EXPECT_TRUE(certificate.proved());
        EXPECT_EQ(certificate.force_ratio.lo, 0);
        EXPECT_EQ(certificate.force_ratio.hi, 0);
        from_start += certificate.verdict == Certified::start ? 1 : 0;
    }
    EXPECT_GT(from_start, cells.size() / 2);
}

// If the start strikes first, the transient is not proved, though the motion without impact is.
TEST(Certify, AStartThatStrikesProvesTheMotionAlone) {
    job::CellNumbers numbers = testing::numbers_170mm(3, 3);
    EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, Certified::start);
    numbers.start.velocity_ratio = 8;
    EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, Certified::orbit);
}

// On the stop's surface the hammer leaves it, or strikes, as its velocity against the cart says.
TEST(Certify, AStartOnTheSurfaceIsToldByItsVelocity) {
    job::CellNumbers numbers = testing::numbers_170mm(3, 3);
    numbers.hammer.damping_ns_per_m.reset();
    numbers.hammer.damping_ratio = 0.6;  // it does not come back to the stop
    numbers.start.displacement_ratio = 3;
    for (const job::Contact& stop : {numbers.contact, job::Contact(job::Restitution{0.5})}) {
        numbers.contact = stop;
        for (const auto& [velocity, verdict] :
             {std::pair(-4.0, Certified::start), std::pair(3.5, Certified::orbit)}) {
            numbers.start.velocity_ratio = velocity;  // that of the cart is 3
            EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, verdict) << velocity;
        }
    }
}

// The steady oscillation has the amplitude eta^2/|1 - eta^2 + 2
// i zeta eta|: a smaller gap rules out motion without impact.
TEST(Certify, NoImpactIsNotProvedBelowTheAmplitude) {
    const double amplitude = testing::free_amplitude(testing::oscillator_at(testing::numbers_170mm(2, 3)));
    const auto verdict = [&](double gap) {
        return certify(testing::numbers_170mm(2, gap), {cell::Regime::no_impact, {}}).verdict;
    };
    EXPECT_EQ(verdict(amplitude * (1 - 1e-12)), Certified::near_grazing);
    EXPECT_EQ(verdict(amplitude), Certified::near_grazing);
    EXPECT_GE(verdict(amplitude * (1 + 1e-12)), Certified::orbit);
}

TEST(Certify, SustainedContactHasTheForceOfItsClosedForm) {
    job::CellNumbers numbers = testing::numbers_170mm(0.7, -8);
    const SolvedPlace place{numbers, testing::solve(testing::oscillator_at(numbers), -8 + 1e-6, 0.7)};
    ASSERT_EQ(place.cell.regime, regime::Regime::sustained_contact);
    const Certificate certificate = certify(numbers, claim_of(place.cell));
    EXPECT_TRUE(certificate.proved());
    EXPECT_TRUE(around(certificate.force_ratio.middle(), 1e-9).holds(force_of(place)));
    EXPECT_LT(certificate.force_ratio.hi - certificate.force_ratio.lo, 1e-11);
    numbers.place.gap_ratio = -0.4;  // the cart throws the hammer off
    EXPECT_EQ(certify(numbers, claim_of(place.cell)).verdict, Certified::near_grazing);
}

TEST(Certify, AFrequencyInHertzAndAGapInMetresAreTheSamePlace) {
    SolvedPlace place = testing::solved_at(2, 0);
    const Certificate by_ratio = certify(place.numbers, claim_of(place.cell));
    place.numbers.place.frequency_hz = 9;
    place.numbers.place.gap_m = 0;
    place.numbers.hammer.damping_ns_per_m.reset();
    place.numbers.hammer.damping_ratio = scene::oscillator_of(testing::numbers_170mm(2, 0)).damping_ratio;
    const Certificate in_si = certify(place.numbers, claim_of(place.cell));
    ASSERT_EQ(in_si.verdict, Certified::orbit);
    EXPECT_FALSE(in_si.force_ratio.apart(by_ratio.force_ratio));
}

TEST(Certify, WhatHasNoTheoremIsNotProved) {
    SolvedPlace place = testing::solved_at(2, 0);
    const Claim claim = claim_of(place.cell);
    ASSERT_EQ(certify(place.numbers, claim).verdict, Certified::orbit);
    EXPECT_EQ(certify(place.numbers, {regime::Regime::chaotic, claim.orbit}).verdict, Certified::not_tried);
    EXPECT_EQ(certify(place.numbers, {regime::Regime::failed, claim.orbit}).verdict, Certified::not_tried);
    place.numbers.hammer.cubic_stiffness_n_per_m3 = 1e9;
    EXPECT_EQ(certify(place.numbers, claim).verdict, Certified::cubic_spring);
    place.numbers.hammer.cubic_stiffness_n_per_m3 = 0;
    place.numbers.contact = job::HuntCrossley{1e9, 1.5, 0.1};
    EXPECT_EQ(certify(place.numbers, claim).verdict, Certified::other_stop);
}

// By an integrator with all terms, at a cell where the cubic term changes the force by more than all errors.
TEST(Certify, TheCubicTermIsPartOfWhatIsProved) {
    for (const job::CubicForm form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        for (const auto& [frequency, gap] : {std::pair(2.0, 0.0), std::pair(1.3, 1.0), std::pair(2.75, 0.0)}) {
            job::CellNumbers numbers = testing::numbers_170mm(frequency, gap);
            const Claim linear = claim_of(testing::solved_at(frequency, gap).cell);
            const Certificate without = certify(numbers, linear);
            numbers.hammer.cubic_stiffness_n_per_m3 = 2382.325;
            numbers.hammer.cubic = form;
            const Certificate with = certify(numbers, linear);
            ASSERT_EQ(with.verdict, Certified::orbit) << frequency;
            EXPECT_TRUE(with.force_ratio.apart(without.force_ratio)) << frequency;
            const scene::Oscillator<double> oscillator = testing::oscillator_at(numbers);
            const SolvedPlace integrated{
                numbers, regime::find_steady_state(oscillator, testing::start_at(oscillator), {},
                                                   {.engine = regime::Engine::cvode, .tolerance = 1e-10})};
            ASSERT_TRUE(regime::same_label(integrated.cell, testing::solved_at(frequency, gap).cell));
            EXPECT_NEAR(force_of(integrated) / with.force_ratio.middle(), 1, 1e-8) << frequency;
        }
    }
}

TEST(Certify, NoImpactIsProvedWithTheCubicTerm) {
    job::CellNumbers numbers = testing::numbers_170mm(3, 3);
    numbers.hammer.cubic_stiffness_n_per_m3 = 238.2325;
    EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, Certified::start);
    const double amplitude = testing::free_amplitude(testing::oscillator_at(numbers));
    numbers.place.gap_ratio = amplitude * (1 + 1e-9);  // less clearance than the cubic term may take
    EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, Certified::near_grazing);
}

// Without any damping there is no attractor.
TEST(Certify, WhatLosesNothingIsNotSurelyStable) {
    job::CellNumbers numbers = testing::numbers_170mm(3, 3);
    numbers.hammer.damping_ns_per_m = 0;
    EXPECT_EQ(certify(numbers, {cell::Regime::no_impact, {}}).verdict, Certified::not_surely_stable);
}

}  // namespace
}  // namespace peterka::certificate
