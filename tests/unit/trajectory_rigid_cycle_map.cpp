// The cycle map of a hammer with a rigid stop: against brute force, differences and extended precision.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>

#include "rigid_rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using testing::rigid;
using Outcome = Cycle<double>::Outcome;

// A fixed-step Runge-Kutta method whose steps end at the impacts, located by bisection.
template <class Real>
struct BruteForce {
    State<Real> end;
    int impacts = 0;
};

BruteForce<long double> brute_force(const scene::Oscillator<double>& oscillator, const State<double>& start,
                                    int steps) {
    using Real = long double;
    const Real r = std::get<scene::Restitution<double>>(oscillator.contact).coefficient;
    const auto slope = [&](const State<Real>& x, Real t) {
        return State<Real>(x[1], oscillator.drive() * std::sin(oscillator.frequency * t) -
                                     2 * oscillator.damping_ratio * x[1] - x[0] - oscillator.gap);
    };
    const auto step = [&](const State<Real>& x, Real t, Real h) -> State<Real> {
        const State<Real> a = slope(x, t);
        const State<Real> b = slope(x + h / 2 * a, t + h / 2);
        const State<Real> c = slope(x + h / 2 * b, t + h / 2);
        const State<Real> d = slope(x + h * c, t + h);
        return x + h / 6 * (a + 2 * b + 2 * c + d);
    };
    const Real period = 2 * std::numbers::pi_v<Real> / oscillator.frequency;
    const Real longest = period / steps;
    BruteForce<Real> result{start.cast<Real>()};
    Real time = 0;
    while (time < period) {
        const Real h = std::min(longest, period - time);
        const State<Real> next = step(result.end, time, h);
        if (next[0] <= 0) {
            result.end = next;
            time += h;
            continue;
        }
        Real below = 0;
        Real above = h;
        for (int n = 0; n < 70; ++n) {
            const Real middle = (below + above) / 2;
            (step(result.end, time, middle)[0] > 0 ? above : below) = middle;
        }
        result.end = step(result.end, time, below);
        result.end = {0, -r * result.end[1]};
        time += below;
        ++result.impacts;
        if (result.impacts > 500) break;
    }
    return result;
}

TEST(RigidCycleMap, AgreesWithBruteForce) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    int impacts = 0;
    int compared = 0;
    for (int n = 0; n < 60; ++n) {
        const auto oscillator = rigid(0.3 + 0.7 * uniform(random), 0.6 + 3 * uniform(random),
                                      2 * uniform(random) - 0.5, n % 3 == 0 ? 0.4 : 0.02);
        const State<double> x(-3 * uniform(random), 8 * uniform(random) - 4);
        const auto cycle = RigidExactMap<double>(oscillator)(x);
        ASSERT_EQ(cycle.outcome, Outcome::done);
        if (cycle.impacts > 12) continue;  // the steps do not resolve the end of a chatter
        const auto expected = brute_force(oscillator, x, 4000);
        EXPECT_EQ(cycle.impacts, expected.impacts) << n;
        EXPECT_LT((cycle.end.cast<long double>() - expected.end).norm(), 1e-9L * (1 + cycle.jacobian.norm()))
            << n;
        impacts += cycle.impacts;
        ++compared;
    }
    EXPECT_GT(compared, 40);
    EXPECT_GT(impacts, 40);
}

TEST(RigidCycleMap, JacobianIsTheDerivative) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    int compared = 0;
    for (int n = 0; n < 200; ++n) {
        const auto oscillator = rigid(uniform(random), 0.5 + 4 * uniform(random), 3 * uniform(random) - 1);
        const RigidExactMap<double> map(oscillator);
        const State<double> x(-0.01 - 4 * uniform(random), 6 * uniform(random) - 3);
        const auto cycle = map(x);
        Jacobian<double> expected;
        bool smooth = cycle.jacobian.norm() < 50;
        for (int i = 0; i < 2; ++i) {
            State<double> shift = State<double>::Zero();
            shift[i] = 1e-6;
            const auto up = map(x + shift);
            const auto down = map(x - shift);
            smooth = smooth && up.pattern == down.pattern && cycle.pattern == up.pattern;
            expected.col(i) = (up.end - down.end) / 2e-6;
        }
        if (!smooth) continue;
        ++compared;
        EXPECT_LT((cycle.jacobian - expected).norm(), 1e-4 * (1 + cycle.jacobian.norm())) << n;
    }
    EXPECT_GT(compared, 130);
}

TEST(RigidCycleMap, AgreesWithLongDouble) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(0, 1);
    int sticks = 0;
    int compared = 0;
    for (int n = 0; n < 400; ++n) {
        const double r = n % 5 == 0 ? 0 : n % 5 == 1 ? 1 : uniform(random);
        const double eta = 0.2 + 4 * uniform(random);
        const double gap = (2 * uniform(random) - 1) * 1.1 * eta * eta;
        const double zeta = n % 4 == 0 ? 0 : 1.4 * uniform(random);
        const RigidExactMap<double> map(rigid(r, eta, gap, zeta));
        const RigidExactMap<long double> finer(rigid<long double>(r, eta, gap, zeta));
        State<double> x(-2 * uniform(random), 4 * uniform(random) - 2);
        for (int c = 0; c < 5; ++c) {
            const auto cycle = map(x);
            const auto expected = finer(x.cast<long double>());
            if (cycle.outcome == Outcome::too_many_events && r == 1) break;  // an elastic hammer under preload
            ASSERT_EQ(cycle.outcome, Outcome::done) << n;
            EXPECT_LE(cycle.end[0], 0);
            EXPECT_EQ(cycle.pattern, expected.pattern) << n;
            EXPECT_LT((cycle.end.cast<long double>() - expected.end).norm(),
                      1e-12L * (1 + eta * eta + x.norm()) * (1 + expected.jacobian.norm()))
                << n;
            sticks += cycle.jacobian.norm() == 0;
            ++compared;
            x = cycle.end;
        }
    }
    EXPECT_GT(compared, 1500);
    EXPECT_GT(sticks, 300);
}

TEST(RigidCycleMap, NearlyElasticTendsToElastic) {
    const State<double> x(-1, 3);
    const auto elastic = RigidExactMap<double>(rigid(1, 2.2, 1.0))(x);
    ASSERT_GT(elastic.impacts, 0);
    for (const double loss : {1e-6, 1e-9, 1e-12}) {
        const auto cycle = RigidExactMap<double>(rigid(1 - loss, 2.2, 1.0))(x);
        EXPECT_EQ(cycle.pattern, elastic.pattern);
        const double change = (cycle.end - elastic.end).norm();
        EXPECT_LT(change, 20 * loss + 1e-13);
        EXPECT_GT(change, loss / 20);
    }
    // without any dissipation areas are preserved
    const auto conservative = RigidExactMap<double>(rigid(1, 2.2, 1.0, 0))(x);
    EXPECT_NEAR(std::abs(conservative.jacobian.determinant()), 1, 1e-12);
}

// A preloaded hammer that loses hardly any speed hops too often: an outcome, not an endless loop.
TEST(RigidCycleMap, TooManyImpactsAreAnOutcome) {
    for (const double r : {1 - 1e-6, 1 - 1e-12}) {
        const auto cycle = RigidExactMap<double>(rigid(r, 0.05, -2))({-1e-6, 1e-3});
        EXPECT_EQ(cycle.outcome, Outcome::too_many_events) << r;
    }
    EXPECT_EQ(RigidExactMap<double>(rigid(0.99, 0.05, -2))({-1e-6, 1e-3}).outcome, Outcome::done);
}

TEST(RigidCycleMap, RefusesStartsInsideTheStop) {
    const RigidExactMap<double> map(rigid(0.6, 2, 0.5));
    EXPECT_EQ(map({1e-3, 0}).outcome, Outcome::inside_stop);
    EXPECT_EQ(map({1e-16, -1}).outcome, Outcome::done);
    EXPECT_EQ(map({NAN, 0}).outcome, Outcome::not_finite);
    EXPECT_EQ(map({-1e306, 1e308}).outcome, Outcome::not_finite);
    EXPECT_EQ(map({0, 3}).impacts, map({-1e-13, 3}).impacts);  // an impact at phase 0
}

}  // namespace
}  // namespace peterka::trajectory
