// Neighbourhoods of stable orbits: every state inside must really end on the orbit.
#include "regime/neighbourhood.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "regime/adapted_norm.hpp"
#include "regime/scalar_engine.hpp"
#include "rig.hpp"
#include "scene/in_precision.hpp"
#include "study/taylor_cycle_map.hpp"

namespace peterka::regime {
namespace {

using testing::beam_150mm;
using testing::beam_170mm;
using testing::paper_rig;

TEST(AdaptedNorm, ContractsAtOnceWhereVectorsAreStretchedOnTheWay) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 1000; ++n) {
        Eigen::Matrix2d jacobian;
        jacobian << normal(random), 30 * normal(random), normal(random), normal(random);
        jacobian *= 0.9 / spectral_radius(jacobian);
        const AdaptedNorm norm(jacobian, 0.9);
        const Point x(normal(random), normal(random));
        EXPECT_LE(norm(jacobian * x), 0.95 * norm(x) * (1 + 1e-9));
        EXPECT_GE(norm(x), x.norm() * (1 - 1e-9));
    }
}

TEST(Neighbourhood, IsAnEllipseInItsBox) {
    Eigen::Matrix2d metric;
    metric << 4, 1.5, 1.5, 1;
    const Neighbourhood ellipse({0.3, -2}, metric, 0.5);
    EXPECT_TRUE(ellipse.contains(ellipse.centre()));
    Point farthest = Point::Zero();
    for (int n = 0; n < 3600; ++n) {
        const Point offset = ellipse.boundary(2 * std::numbers::pi * n / 3600) - ellipse.centre();
        EXPECT_NEAR(std::sqrt(offset.dot(metric * offset)), 0.5, 1e-12);
        EXPECT_TRUE(ellipse.contains(ellipse.centre() + 0.999999 * offset));
        EXPECT_FALSE(ellipse.contains(ellipse.centre() + 1.000001 * offset));
        farthest = farthest.cwiseMax(offset);
    }
    EXPECT_NEAR(farthest[0], ellipse.reach()[0], 1e-5);
    EXPECT_NEAR(farthest[1], ellipse.reach()[1], 1e-5);
    EXPECT_FALSE(ellipse.contains({std::nan(""), 0}));
}

struct Orbit {
    scene::Oscillator<double> oscillator;
    CellResult result;
    std::vector<Neighbourhood> neighbourhoods;
};

Orbit orbit_at(const scene::Oscillator<double>& oscillator, std::int64_t count) {
    const CellResult result = testing::solve(oscillator);
    CycleBroker broker;
    StroboscopicMap map(oscillator, {}, broker);
    const Point point =
        map.scaled(scene::State<double>(result.orbit_displacement - oscillator.gap, result.orbit_velocity));
    return {oscillator, result, complete(find_neighbourhoods(map, point, result.period, count), broker)};
}

// 1/1, 1/2, 2/2 and 3/2 of the 170 mm rig, and the 1/1 that coexists with no impact.
std::vector<Orbit> orbits() {
    return {orbit_at(paper_rig(beam_170mm, 2.0, 0), 1), orbit_at(paper_rig(beam_170mm, 3.5, 0.3), 2),
            orbit_at(paper_rig(beam_170mm, 2.75, 0), 2), orbit_at(paper_rig(beam_170mm, 3.1, 0), 2),
            orbit_at(paper_rig(beam_150mm, 1.8, 1.6), 1)};
}

// Smallest distance, over the q cycles of the period, of a state at forcing phase 0 from the orbit's point of
// smallest displacement, by Taylor series in extended precision.
double distance_after(const Orbit& orbit, scene::State<long double> state, int periods) {
    const study::TaylorCycleMap map(scene::in_precision<long double>(orbit.oscillator));
    const scene::State<double> target(orbit.result.orbit_displacement - orbit.oscillator.gap,
                                      orbit.result.orbit_velocity);
    for (int n = 0; n < periods * orbit.result.period; ++n) state = map(state).end;
    double nearest = 1e9;
    for (int n = 0; n < orbit.result.period; ++n) {
        nearest = std::min(nearest, (state.cast<double>() - target).norm());
        state = map(state).end;
    }
    return nearest;
}

TEST(Neighbourhood, EveryStateInsideConverges) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    std::uniform_real_distribution<double> share(0, 1);
    for (const Orbit& orbit : orbits()) {
        SCOPED_TRACE(::testing::Message() << "z = " << orbit.result.impacts << "/" << orbit.result.period);
        ASSERT_FALSE(orbit.neighbourhoods.empty());
        CycleBroker broker;
        const StroboscopicMap scales(orbit.oscillator, {}, broker);
        for (const Neighbourhood& ellipse : orbit.neighbourhoods) {
            EXPECT_GT(ellipse.reach().minCoeff(), 1e-3);
            for (int n = 0; n < 8; ++n) {
                const Point inside =
                    ellipse.centre() +
                    std::sqrt(share(random)) * (ellipse.boundary(angle(random)) - ellipse.centre());
                const auto start = scales.unscaled(inside);
                const double before = distance_after(orbit, start.cast<long double>(), 0);
                const double after = distance_after(orbit, start.cast<long double>(), 40);
                EXPECT_LT(after, std::max(1e-3 * before, 1e-9)) << inside.transpose();
            }
        }
    }
}

// In the rig with coexisting attractors, the neighbourhood contains no start whose full search ends elsewhere.
TEST(Neighbourhood, HoldsNoStartOfAnotherBasin) {
    const auto oscillator = paper_rig(beam_150mm, 1.8, 1.6);
    const Orbit orbit = orbit_at(oscillator, 1);
    CycleBroker broker;
    const StroboscopicMap scales(oscillator, {}, broker);
    int inside = 0;
    int elsewhere = 0;
    for (double displacement = -4; displacement <= 1.6; displacement += 0.1) {
        for (double velocity = -4; velocity <= 4; velocity += 0.1) {
            const CellResult full = testing::solve(oscillator, displacement, velocity);
            const bool is_inside = orbit.neighbourhoods.front().contains(
                scales.scaled(testing::start_at(oscillator, displacement, velocity)));
            inside += is_inside ? 1 : 0;
            elsewhere += full.regime == Regime::no_impact ? 1 : 0;
            EXPECT_FALSE(is_inside && full.regime == Regime::no_impact) << displacement << " " << velocity;
        }
    }
    EXPECT_GT(inside, 20);
    EXPECT_GT(elsewhere, 20);
}

TEST(Neighbourhood, NoneWhereThePointIsNoOrbit) {
    const auto oscillator = paper_rig(beam_170mm, 2.0, 0);
    CycleBroker broker;
    StroboscopicMap map(oscillator, {}, broker);
    EXPECT_TRUE(complete(find_neighbourhoods(map, {-1, 0.5}, 1, 1), broker).empty());
}

}  // namespace
}  // namespace peterka::regime
