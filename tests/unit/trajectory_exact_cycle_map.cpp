// The stroboscopic map: its Jacobian, and its agreement with a general-purpose integrator.
#include "trajectory/exact_cycle_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "integrators/integrated_cycle_map.hpp"
#include "observed.hpp"
#include "rig.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;
using testing::beam_170mm;
using testing::observed;
using testing::paper_rig;

// Central differences of the map, if the contacts are the same on both sides.
std::optional<Jacobian<double>> differences(const ExactCycleMap<double>& map, const State<double>& x) {
    constexpr double h = 1e-6;
    Jacobian<double> jacobian;
    for (int i = 0; i < 2; ++i) {
        State<double> shift = State<double>::Zero();
        shift[i] = h;
        const auto up = map(x + shift);
        const auto down = map(x - shift);
        if (up.pattern != down.pattern) return std::nullopt;
        jacobian.col(i) = (up.end - down.end) / (2 * h);
    }
    return jacobian;
}

TEST(ExactCycleMap, JacobianIsTheDerivative) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(-1, 3);
    std::normal_distribution<double> state(0, 3);
    int compared = 0;
    for (int n = 0; n < 300; ++n) {
        const ExactCycleMap<double> map(paper_rig(beam_170mm, frequency(random), gap(random)));
        const State<double> x(state(random), state(random));
        const auto cycle = map(x);
        const auto expected = differences(map, x);
        if (!expected || cycle.pattern != observed(map, x).pattern) continue;
        const double size = cycle.jacobian.norm();
        if (size > 50) continue;  // near grazing the differences themselves are inaccurate
        ++compared;
        EXPECT_LT((cycle.jacobian - *expected).norm(), 1e-4 * (1 + size))
            << map.oscillator().frequency << " " << x.transpose();
    }
    EXPECT_GT(compared, 200);
}

TEST(ExactCycleMap, ShrinksAreasByItsDissipation) {
    // det J = exp(-2 zeta T) exp(-chi t_contact): the saltation matrices of the entries preserve area
    const auto oscillator = paper_rig(beam_170mm, 2.0, 0.0);
    const auto cycle = ExactCycleMap<double>(oscillator)({-5.0, -2.7});
    ASSERT_EQ(cycle.impacts, 1);
    EXPECT_LT(cycle.jacobian.determinant(), std::exp(-2 * oscillator.damping_ratio * oscillator.period()));
    EXPECT_GT(cycle.jacobian.determinant(), 0);
}

TEST(ExactCycleMap, AgreesWithIntegrationFromRandomStarts) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> frequency(0.6, 4.0);
    std::uniform_real_distribution<double> gap(-0.5, 2);
    std::uniform_real_distribution<double> speed(-3, 3);
    int impacts = 0;
    for (int n = 0; n < 40; ++n) {
        auto oscillator = paper_rig(beam_170mm, frequency(random), gap(random));
        if (n % 4 == 1) oscillator.kelvin_voigt().damping *= 12;  // an overdamped stop
        if (n % 4 == 2) oscillator.kelvin_voigt().damping = 0;    // an elastic one
        if (n % 4 == 3) oscillator.damping_ratio = 0.4;
        const State<double> start(speed(random) - oscillator.gap, speed(random));
        const auto cycle = observed(ExactCycleMap<double>(oscillator), start);
        const auto expected = IntegratedCycleMap(oscillator, Integrator::cvode_bdf, 1e-8)(start);
        impacts += cycle.impacts;
        EXPECT_EQ(cycle.impacts, expected.impacts) << n;
        EXPECT_EQ(cycle.pattern, expected.pattern) << n;
        EXPECT_NEAR(cycle.end[0], expected.end[0], 2e-6) << n;
        EXPECT_NEAR(cycle.end[1], expected.end[1], 2e-6) << n;
    }
    EXPECT_GT(impacts, 30);
}

}  // namespace
}  // namespace peterka::trajectory
