// The cycle map of a hammer that hits a rigid stop: against analytic orbits, brute force and balances.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/free_flight.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using Outcome = Cycle<double>::Outcome;

template <class Real = double>
scene::Oscillator<Real> rigid(double restitution, double frequency, double gap, double zeta = 0.02) {
    return {.damping_ratio = static_cast<Real>(zeta),
            .contact = scene::Restitution<Real>{static_cast<Real>(restitution)},
            .frequency = static_cast<Real>(frequency),
            .gap = static_cast<Real>(gap)};
}

// One impact in n cycles, by formula: A = [[0, 1], [-1, -2 zeta]], E = exp(A T).
struct SingleImpactOrbit {
    double speed;                // before the impact
    double phase;                // of the forcing at the impact
    State<double> at_phase_0;    // (delta, delta')
    Jacobian<double> monodromy;  // from just before an impact to just before the next
    double fold;                 // the gap up to which it exists

    SingleImpactOrbit(double r, double eta, double gap, int n, double zeta = 0.02) {
        const double period = 2 * std::numbers::pi * n / eta;
        const double rate = std::sqrt(1 - zeta * zeta);
        const auto flow = [&](double t) {
            const double decay = std::exp(-zeta * t);
            const double s = decay * std::sin(rate * t) / rate;
            const double c = decay * std::cos(rate * t);
            return Jacobian<double>{{c + zeta * s, s}, {-s, c - zeta * s}};
        };
        const Jacobian<double> e = flow(period);
        const Jacobian<double> inverse = (e - Jacobian<double>::Identity()).inverse();
        const double alpha = (1 + r) * inverse(0, 1);
        const double beta = (1 + r) * inverse(1, 1);
        const double drive = eta * eta;
        const double p = drive / std::hypot(1 - drive, 2 * zeta * eta);
        const double a = alpha * alpha + (r + beta) * (r + beta) / drive;
        const double b = -alpha * gap;
        speed = (-b + std::sqrt(b * b - a * (gap * gap - p * p))) / a;
        fold = p * std::sqrt(1 + alpha * alpha * drive / ((r + beta) * (r + beta)));
        const double theta = std::atan2((gap - alpha * speed) / p, -(r + beta) * speed / (p * eta));
        const double lag = std::atan2(2 * zeta * eta, 1 - drive);
        phase = std::fmod(theta + lag + 4 * std::numbers::pi, 2 * std::numbers::pi);
        Jacobian<double> saltation;
        saltation << -r, 0, (1 + r) * (drive * std::sin(phase) - gap) / speed, -r;
        monodromy = e * saltation;
        // on to the next phase 0
        const double time = (2 * std::numbers::pi - phase) / eta;
        const auto steady = [&](double angle) {
            return State<double>(p * std::sin(angle), p * eta * std::cos(angle));
        };
        const State<double> after(gap, -r * speed);
        at_phase_0 = flow(time) * (after - steady(theta)) + steady(theta + eta * time) - State<double>(gap, 0);
    }
};

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

// Newton's method on (orbit closes, multiplier is exactly so), derivatives by differences.
double critical(double multiplier, Eigen::Vector3d y,
                const std::function<scene::Oscillator<double>(double)>& oscillator) {
    const auto residual = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        const auto cycle = RigidExactMap<double>(oscillator(at[2]))(State<double>(at[0], at[1]));
        const auto& j = cycle.jacobian;
        return {cycle.end[0] - at[0], cycle.end[1] - at[1],
                multiplier * multiplier - multiplier * j.trace() + j.determinant()};
    };
    for (int step = 0; step < 20; ++step) {
        Eigen::Matrix3d slope;
        for (int i = 0; i < 3; ++i) {
            Eigen::Vector3d shift = Eigen::Vector3d::Zero();
            shift[i] = 1e-6;
            slope.col(i) = (residual(y + shift) - residual(y - shift)) / 2e-6;
        }
        const Eigen::Vector3d correction = slope.partialPivLu().solve(-residual(y));
        y += correction;
        if (correction.norm() < 1e-13) break;
    }
    return y[2];
}

TEST(RigidOrbit, DoublesItsPeriodWhereTheFormulaSays) {
    for (const auto& [gap, frequency] : {std::pair{0.0, 2.6609482425529}, std::pair{0.5, 2.494678798104}}) {
        const SingleImpactOrbit nearby(0.6, frequency - 1e-3, gap, 1);
        const double found = critical(-1, {nearby.at_phase_0[0], nearby.at_phase_0[1], frequency - 1e-3},
                                      [gap = gap](double eta) { return rigid(0.6, eta, gap); });
        EXPECT_NEAR(found, frequency, 1e-11);
    }
}

TEST(RigidOrbit, FoldsWhereTheFormulaSays) {
    const double eta = 1.7;
    const double fold = SingleImpactOrbit(0.6, eta, 0, 1).fold;
    const SingleImpactOrbit nearby(0.6, eta, fold * (1 - 1e-4), 1);
    const double found = critical(1, {nearby.at_phase_0[0], nearby.at_phase_0[1], fold * (1 - 1e-4)},
                                  [eta](double gap) { return rigid(0.6, eta, gap); });
    EXPECT_NEAR(found, fold, 1e-9);
}

// A fixed-step Runge-Kutta method whose steps end at the impacts, found by bisection.
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
        if (cycle.impacts > 12) continue;  // steps don't resolve the end of a chatter
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

// r = 0 and gap 0: the hammer sticks from its first impact while 4 sin(theta) > 0, and falls from theta = pi
// on.
TEST(RigidCycleMap, SticksUntilThePhaseOfRelease) {
    for (const double gap : {0.0, 0.5, 1.0}) {
        const auto oscillator = rigid(0, 2, gap);
        const RigidStop<double> stop(oscillator);
        const double release = std::numbers::pi - std::asin(gap / 4);
        // from rest at the release to the end of the cycle
        const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
        const Leg<double> fall(flight, State<double>::Zero(), release);
        const State<double> expected = fall.at((2 * std::numbers::pi - release) / 2).state;
        ASSERT_LT(expected[0], 0);

        const State<double> x(-1, 5);
        Recorder<double> recorder(Detail::contacts);
        const auto cycle = RigidExactMap<double>(oscillator)(x, &recorder);
        ASSERT_EQ(cycle.impacts, 1);
        EXPECT_LT((cycle.end - expected).norm(), 1e-14);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_TRUE(cycle.touched);
        EXPECT_TRUE(cycle.separated);

        const Leg<double> rise(flight, x, 0);
        const Probe<double> touch({.position = 1}, flight);
        const auto hit = first_crossing(rise, touch, rise.start(), 1.0);
        const double duration = release / 2 - hit.moment.time;
        const auto& totals = recorder.totals();
        EXPECT_NEAR(totals.contact_time, duration, 1e-14);
        const double pressed = 2 * (std::cos(2 * hit.moment.time) - std::cos(release)) - gap * duration;
        EXPECT_NEAR(totals.impulse, hit.moment.state[1] + pressed, 1e-12);
        EXPECT_NEAR(totals.largest_force, 4 - gap, 1e-14);
        EXPECT_FALSE(totals.chatter) << "one impact is no chatter";
        EXPECT_EQ(totals.impacts, 1);
    }
}

// Many small impacts end in rest: one impact, flagged, and as long as the impacts one by one say.
TEST(RigidCycleMap, ACompletedChatterIsOneImpact) {
    for (const double r : {0.2, 0.6, 0.8}) {
        const auto oscillator = rigid(r, 1.3, 0.2);
        const RigidExactMap<double> map(oscillator);
        const State<double> x(-0.01, 0.05);
        Recorder<double> recorder(Detail::energy);
        const auto cycle = map(x, &recorder);
        Recorder<long double> finer(Detail::energy);
        const auto expected =
            RigidExactMap<long double>(rigid<long double>(r, 1.3, 0.2))(x.cast<long double>(), &finer);
        EXPECT_GT(expected.impacts, cycle.impacts);  // followed further
        const auto& totals = recorder.totals();
        EXPECT_TRUE(totals.chatter);
        EXPECT_EQ(totals.impacts, 1) << r;
        EXPECT_EQ(cycle.pattern, expected.pattern);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_NEAR(totals.contact_time, static_cast<double>(finer.totals().contact_time), 1e-13);
        EXPECT_NEAR(totals.impulse, static_cast<double>(finer.totals().impulse), 1e-13);
        EXPECT_NEAR(totals.contact_work, static_cast<double>(finer.totals().contact_work), 1e-13);
    }
}

// Two chains of which only the second ends in rest: the first counts impact by impact.
TEST(RigidCycleMap, ChatterThatIsNotCompletedCountsEachImpact) {
    const auto oscillator = rigid(0.9, 3.0, 0.0);
    Recorder<double> recorder;
    const auto cycle = RigidExactMap<double>(oscillator)({-0.1, 4}, &recorder);
    ASSERT_GT(cycle.impacts, 0);
    EXPECT_FALSE(recorder.totals().chatter);
    EXPECT_EQ(recorder.totals().impacts, cycle.impacts);
    EXPECT_FALSE(recorder.is_open());
}

// At a negative gap the hammer is pressed at phase 0, and a chatter may go on there. On the periodic orbit the
// impulse over a cycle is minus the integral of u, and the energy balance closes.
TEST(RigidCycleMap, ChatterMayCrossTheEndOfACycle) {
    int crossed = 0;
    for (const auto& [eta, gap] :
         {std::pair{0.4, -0.1}, std::pair{0.6, -0.3}, std::pair{0.8, -0.55}, std::pair{1.0, -0.9}}) {
        for (const double r : {0.3, 0.6, 0.8}) {
            const auto oscillator = rigid(r, eta, gap);
            const RigidLegs<double> legs(oscillator);
            const RigidExactMap<double> map(oscillator);
            State<double> x(-1, 0);
            for (int n = 0; n < 300; ++n) x = map(x).end;
            Recorder<double> recorder(Detail::energy);
            const auto first = map(x, &recorder);
            ASSERT_LT((first.end - x).norm(), 1e-12);
            ASSERT_TRUE(recorder.is_open() && first.separated);
            crossed += x[0] < 0;  // not in rest at phase 0
            recorder.reset_totals();
            std::ignore = map(x, &recorder);
            const auto& totals = recorder.totals();
            EXPECT_EQ(totals.impacts, 1) << gap << " " << r;
            EXPECT_TRUE(totals.chatter);
            EXPECT_NEAR(totals.drive_work, totals.damper_work + totals.contact_work, 1e-12);
            // trapezoids; the state between is that of a journey which stops there
            constexpr int pieces = 4000;
            double sum = 0;
            Journey<double> journey = legs.depart(x);
            double last = x[0];
            for (int n = 1; n <= pieces; ++n) {
                ASSERT_TRUE(legs.run(journey, oscillator.period() * n / pieces, nullptr));
                sum += (last + journey.cycle.end[0]) / 2 + gap;
                last = journey.cycle.end[0];
            }
            EXPECT_NEAR(totals.impulse, -sum * oscillator.period() / pieces, 1e-5) << gap << " " << r;
        }
    }
    EXPECT_GE(crossed, 6);
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
            if (cycle.outcome == Outcome::too_many_events && r == 1)
                break;  // an elastic hammer that is pressed
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
    // without any loss areas stay what they are
    const auto conservative = RigidExactMap<double>(rigid(1, 2.2, 1.0, 0))(x);
    EXPECT_NEAR(std::abs(conservative.jacobian.determinant()), 1, 1e-12);
}

// A hammer that is pressed all the time and hardly loses speed hops too often: an outcome, not an endless loop.
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

// Kicks vanish at the stop, so sticking is that of the linear equation, which carries the cubic's load there.
TEST(RigidSplitMap, SticksAsTheCubicSpringLetsIt) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        auto oscillator = rigid(0.05, 2, 0.3);
        oscillator.cubic = 0.05;
        oscillator.cubic_form = form;
        const State<double> x(-1, 5);
        Recorder<double> recorder(Detail::contacts);
        const auto cycle = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 400)(x, &recorder);
        ASSERT_EQ(cycle.outcome, Outcome::done);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_EQ(recorder.totals().impacts, 1);
        // second order in the step
        Recorder<double> finer(Detail::contacts);
        const auto fine = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 1600)(x, &finer);
        Recorder<double> coarser(Detail::contacts);
        const auto coarse = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 100)(x, &coarser);
        EXPECT_LT((cycle.end - fine.end).norm(), 3e-5);
        EXPECT_LT((cycle.end - fine.end).norm(), (coarse.end - fine.end).norm() / 8);
        EXPECT_NEAR(recorder.totals().contact_time, finer.totals().contact_time, 1e-5);
    }
    // without a cubic the steps change nothing
    const auto oscillator = rigid(0.6, 1.3, 0.2);
    const State<double> x(-0.01, 0.3);
    EXPECT_LT((::peterka::trajectory::RigidSplitMap<double>(oscillator, 20)(x).end -
               RigidExactMap<double>(oscillator)(x).end)
                  .norm(),
              1e-14);
}

}  // namespace
}  // namespace peterka::trajectory
