// Periodic orbits of a hammer with a rigid stop: against the formulas for one impact in n cycles.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <utility>

#include "critical_parameter.hpp"
#include "rigid_rig.hpp"
#include "single_impact_orbit.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using testing::critical_parameter;
using testing::rigid;
using testing::SingleImpactOrbit;
using Outcome = Cycle<double>::Outcome;

TEST(RigidOrbit, OneImpactInNCyclesIsThatOfTheFormula) {
    struct Case {
        double eta, gap;
        int n;
        double speed;
    };
    for (const auto& [eta, gap, n, speed] : {Case{2, 0, 1, 11.841323894932}, Case{2, 0.5, 1, 10.966655235621},
                                             Case{4, 0, 2, 18.951633786639}, Case{2.4, -0.3, 1, 0}}) {
        const SingleImpactOrbit orbit(0.6, eta, gap, n);
        if (speed > 0) {
            EXPECT_NEAR(orbit.speed, speed, 1e-11 * speed);
        }
        const RigidExactMap<double> map(rigid(0.6, eta, gap));
        State<double> x = orbit.at_phase_0;
        Jacobian<double> jacobian = Jacobian<double>::Identity();
        Recorder<double> recorder(Detail::energy);
        for (int cycle = 0; cycle < n; ++cycle) {
            const auto passed = map(x, &recorder);
            ASSERT_EQ(passed.outcome, Outcome::done);
            x = passed.end;
            jacobian = (passed.jacobian * jacobian).eval();
        }
        EXPECT_LT((x - orbit.at_phase_0).norm(), 1e-12);
        EXPECT_NEAR(jacobian.trace(), orbit.monodromy.trace(), 1e-12);
        EXPECT_NEAR(jacobian.determinant(), orbit.monodromy.determinant(), 1e-12);
        EXPECT_NEAR(jacobian.determinant(), 0.36 * std::exp(-2 * 0.02 * 2 * std::numbers::pi * n / eta), 1e-13);

        const auto& totals = recorder.totals();
        EXPECT_EQ(totals.impacts, 1);
        EXPECT_FALSE(totals.chatter);
        EXPECT_TRUE(std::isnan(totals.peak_force()));
        EXPECT_NEAR(totals.impact_speed, orbit.speed, 1e-12 * orbit.speed);
        EXPECT_NEAR(totals.impulse, 1.6 * orbit.speed, 1e-11 * orbit.speed);
        EXPECT_EQ(totals.contact_time, 0);
        EXPECT_NEAR(totals.contact_work, 0.32 * orbit.speed * orbit.speed, 1e-11 * totals.contact_work);
        EXPECT_NEAR(totals.drive_work, totals.damper_work + totals.contact_work, 2e-12 * totals.drive_work);
    }
}

TEST(RigidOrbit, DoublesItsPeriodWhereTheFormulaSays) {
    for (const auto& [gap, frequency] : {std::pair{0.0, 2.6609482425529}, std::pair{0.5, 2.494678798104}}) {
        const SingleImpactOrbit nearby(0.6, frequency - 1e-3, gap, 1);
        const double found =
            critical_parameter([gap = gap](double eta) { return RigidExactMap<double>(rigid(0.6, eta, gap)); },
                               -1, nearby.at_phase_0, frequency - 1e-3);
        EXPECT_NEAR(found, frequency, 1e-11);
    }
}

TEST(RigidOrbit, FoldsWhereTheFormulaSays) {
    const double eta = 1.7;
    const double fold = SingleImpactOrbit(0.6, eta, 0, 1).fold;
    const SingleImpactOrbit nearby(0.6, eta, fold * (1 - 1e-4), 1);
    const double found =
        critical_parameter([eta](double gap) { return RigidExactMap<double>(rigid(0.6, eta, gap)); }, 1,
                           nearby.at_phase_0, fold * (1 - 1e-4));
    EXPECT_NEAR(found, fold, 1e-9);
}

}  // namespace
}  // namespace peterka::trajectory
