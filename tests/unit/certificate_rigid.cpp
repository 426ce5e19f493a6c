// Proofs for a rigid stop, against the engine, which shares no code with them, and against formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "certificate/certify.hpp"
#include "certified_cells.hpp"
#include "single_impact_orbit.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;

// From A0 omega.
double speed_in_si(const job::CellNumbers& numbers, double speed) {
    return scene::scales_of(numbers).in_unit_of_file(speed, cell::Dimension::speed);
}

double zeta_of(const job::CellNumbers& numbers) {
    return testing::oscillator_at(numbers).damping_ratio;
}

job::CellNumbers numbers_at(double restitution, double frequency_ratio, double gap_ratio) {
    job::CellNumbers numbers = testing::numbers_170mm(frequency_ratio, gap_ratio);
    numbers.contact = job::Restitution{restitution};
    return numbers;
}

class CertifyRigid : public ::testing::TestWithParam<double> {};

TEST_P(CertifyRigid, NearlyAllOrbitsAreProvedWithTheirLargestSpeeds) {
    const auto cells = testing::cells_of(regime::Regime::periodic, 24, job::Restitution{GetParam()});
    ASSERT_GT(cells.size(), 150U);
    std::size_t proved = 0;
    for (const SolvedPlace& place : cells) {
        const Certificate certificate = certify(place.numbers, claim_of(place.cell));
        if (!certificate.proved()) continue;
        ++proved;
        const double speed = speed_in_si(place.numbers, place.cell.impact_speed);
        EXPECT_TRUE(std::isnan(certificate.force_ratio.lo));
        EXPECT_LE(certificate.impact_speed.lo, speed * (1 + 1e-9));
        EXPECT_GE(certificate.impact_speed.hi, speed * (1 - 1e-9));
        EXPECT_LT(certificate.impact_speed.hi / certificate.impact_speed.lo - 1, 1e-7);
        EXPECT_GT(certificate.stability_margin, 0);
        EXPECT_LE(certificate.stability_margin, 2 * (1 - place.cell.multiplier) + 1e-9);
    }
    EXPECT_GT(static_cast<double>(proved), 0.95 * static_cast<double>(cells.size()));
}

INSTANTIATE_TEST_SUITE_P(Restitutions, CertifyRigid, ::testing::Values(0.0, 0.32, 0.8, 0.97));

// One impact in n cycles: its speed, and with det M and tr M its margin of stability.
TEST(CertifyRigid, OneImpactInSeveralCyclesIsThatOfItsFormula) {
    int proved = 0;
    for (const double r : {0.6, 0.8, 0.9}) {
        for (const int n : {1, 2, 3}) {
            const job::CellNumbers numbers = numbers_at(r, 2.0 * n * 1.05, 0);
            const testing::SingleImpactOrbit orbit(r, numbers.frequency_ratio(), 0, n, zeta_of(numbers));
            const Claim claim{cell::Regime::periodic,
                              {1, n, orbit.at_phase_0[0], orbit.at_phase_0[1] + numbers.frequency_ratio()}};
            const Certificate certificate = certify(numbers, claim);
            const double margin =
                std::min(1 - std::abs(orbit.monodromy.determinant()),
                         1 + orbit.monodromy.determinant() - std::abs(orbit.monodromy.trace()));
            EXPECT_EQ(certificate.proved(), margin > 0) << r << " " << n;
            if (!certificate.proved()) continue;
            ++proved;
            EXPECT_NEAR(certificate.impact_speed.lo / speed_in_si(numbers, orbit.speed), 1, 1e-12);
            EXPECT_NEAR(certificate.impact_speed.hi / speed_in_si(numbers, orbit.speed), 1, 1e-12);
            EXPECT_NEAR(certificate.stability_margin, margin, 1e-10);
            EXPECT_LE(certificate.stability_margin, margin + 1e-13);
        }
    }
    EXPECT_GT(proved, 6);
}

// r = 0, gap 0: the hammer lifts off when the cart's acceleration vanishes, at eta tau = pi, and flies as a
// damped oscillator does until it strikes and sticks: its speed by formula, its time by bisection.
TEST(CertifyRigid, TheSpeedOfAStickingHammerIsThatOfItsFormula) {
    for (const double eta : {1.4, 1.7, 1.9}) {
        const job::CellNumbers numbers = numbers_at(0, eta, 0);
        const SolvedPlace place = testing::solved(numbers);
        ASSERT_EQ(place.cell.regime, regime::Regime::periodic);
        const Certificate certificate = certify(numbers, claim_of(place.cell));
        ASSERT_EQ(certificate.verdict, Certified::orbit) << eta;
        EXPECT_EQ(certificate.stability_margin, 1);

        const double zeta = zeta_of(numbers);
        const double rate = std::sqrt(1 - zeta * zeta);
        const double amplitude = testing::free_amplitude(testing::oscillator_at(numbers));
        const double lag = std::atan2(2 * zeta * eta, 1 - eta * eta);
        const double at_rest_u = amplitude * std::sin(lag);  // minus the response at eta tau = pi, and its rate
        const double at_rest_v = amplitude * eta * std::cos(lag);
        const auto position = [&](double t) {
            const double decay = std::exp(-zeta * t);
            return -amplitude * std::sin(eta * t - lag) +
                   decay * (-at_rest_u * std::cos(rate * t) +
                            (at_rest_v - zeta * at_rest_u) / rate * std::sin(rate * t));
        };
        double before = 0.5;
        while (position(before) < 0) before += 0.01;
        double low = before - 0.01;
        double high = before;
        for (int i = 0; i < 60; ++i) (position(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
        const double step = 1e-5;
        const double speed = (position(low + step) - position(low - step)) / (2 * step);
        EXPECT_NEAR(certificate.impact_speed.middle() / speed_in_si(numbers, speed), 1, 1e-8) << eta;
    }
}

// The same equation has an orbit whose hammer passes through the stop: it isn't one.
TEST(CertifyRigid, AnOrbitThatEndsAtAGrazingIsProvedUpToThere) {
    const job::CellNumbers numbers = numbers_at(0.8, 2.0, 0);
    const SolvedPlace place = testing::solved(numbers);
    ASSERT_EQ(place.cell.regime, regime::Regime::periodic);
    ASSERT_TRUE(certify(numbers, claim_of(place.cell)).proved());
    for (const double gap : {-3.0, 3.0}) {
        job::CellNumbers elsewhere = numbers;
        elsewhere.place.gap_ratio = gap;
        EXPECT_FALSE(certify(elsewhere, claim_of(place.cell)).proved()) << gap;
    }
}

// Rest on the stop for good: the cart must be too slow to throw the hammer off.
TEST(CertifyRigid, RestIsProvedWhereTheHammerIsPressedAlways) {
    job::CellNumbers numbers = numbers_at(0.5, 0.7, -0.5);
    const Claim claim{cell::Regime::sustained_contact, {}};
    const Certificate certificate = certify(numbers, claim);
    EXPECT_TRUE(certificate.proved());
    EXPECT_EQ(certificate.impact_speed.hi, 0);
    numbers.place.gap_ratio = -0.48;  // eta^2 = 0.49
    EXPECT_EQ(certify(numbers, claim).verdict, Certified::near_grazing);
}

// Without loss there is no attractor.
TEST(CertifyRigid, WhatLosesNothingIsNotSurelyStable) {
    job::CellNumbers numbers = numbers_at(1, 2.1, 0);
    numbers.hammer.damping_ns_per_m = 0;
    const testing::SingleImpactOrbit orbit(1, 2.1, 0, 1, 0);
    const Claim claim{cell::Regime::periodic,
                      {1, 1, orbit.at_phase_0[0], orbit.at_phase_0[1] + numbers.frequency_ratio()}};
    EXPECT_FALSE(certify(numbers, claim).proved());
}

}  // namespace
}  // namespace peterka::certificate
