// One cell for each regime and status without a quantitative
// test elsewhere, with its number verified independently.
#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <complex>
#include <tuple>
#include <vector>

#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {
namespace {

using testing::beam_170mm;
using testing::paper_cubic;
using testing::paper_rig;
using testing::start_at;
using LongState = scene::State<long double>;

CellResult solved(double cubic, double frequency_ratio, double gap_ratio) {
    job::Job job = testing::job_170mm(cubic);
    job.columns = {frequency_ratio, frequency_ratio + 1, 2};
    job.rows = {gap_ratio, gap_ratio + 1, 2};
    return solve_cell(scene::Scene(job), 0, 0);
}

trajectory::ExactCycleMap<long double> in_extended_precision(const scene::Oscillator<double>& oscillator) {
    const scene::KelvinVoigt<double>& stop = oscillator.kelvin_voigt();
    scene::Oscillator<long double> same;
    same.damping_ratio = oscillator.damping_ratio;
    same.contact = scene::KelvinVoigt<long double>{stop.stiffness, stop.damping};
    same.frequency = oscillator.frequency;
    same.gap = oscillator.gap;
    return trajectory::ExactCycleMap<long double>(same);
}

// ln of the largest growth of errors introduced in any cycle, by the distance of trajectories that begin near
// each of its points. In units of A0 and A0 omega.
double growth_of_errors(const scene::Oscillator<double>& oscillator, int cycles) {
    constexpr long double aside = 1e-17L;
    const auto map = in_extended_precision(oscillator);
    std::vector<LongState> points{start_at(oscillator).cast<long double>()};
    std::vector<double> squares(static_cast<std::size_t>(cycles) + 1, 0);  // of errors, after this many cycles
    for (int n = 0; n < cycles; ++n) points.push_back(map(points.back()).end);
    for (int first = 0; first < cycles; ++first) {
        for (int axis = 0; axis < 2; ++axis) {
            LongState x = points[static_cast<std::size_t>(first)];
            x[axis] += aside;
            for (int n = first + 1; n <= cycles; ++n) {
                x = map(x).end;
                const auto after = static_cast<std::size_t>(n);
                squares[after] += static_cast<double>((x - points[after]).squaredNorm() / (aside * aside)) / 2;
            }
        }
    }
    return std::log(*std::ranges::max_element(squares)) / 2;
}

// Finally periodic, after a chaotic transient that amplified errors by e^20 and more.
TEST(EachStatus, RoundingIsSaidWhereErrorsGrewByE20) {
    const CellResult cell = solved(0, 4.2359429184586199, 1.2353618165505185);
    ASSERT_EQ(cell.regime, Regime::periodic);
    EXPECT_EQ(cell.status, Status::rounding);
    const auto oscillator = paper_rig(beam_170mm, 4.2359429184586199, 1.2353618165505185);
    const double growth = growth_of_errors(oscillator, cell.followed_cycles);
    EXPECT_GT(growth, 20);
    EXPECT_NEAR(cell.sensitivity, growth, 1.5);  // the two scale speeds differently
}

TEST(EachStatus, VerifiedIsSaidWhereErrorsStayedSmall) {
    const CellResult cell = solved(0, 2, 0.5);
    ASSERT_EQ(cell.regime, Regime::periodic);
    EXPECT_EQ(cell.status, Status::verified);
    const double growth = growth_of_errors(paper_rig(beam_170mm, 2, 0.5), cell.followed_cycles);
    EXPECT_LT(growth, 20);
    EXPECT_NEAR(cell.sensitivity, growth, 1.5);
}

// Time of blow-up of softening springs without damping, x" = -(1 + cubic x^2) x, from rest at x: by the
// integral of dx/x' from their energy, in s = x/x0 = 1/(1 - w^2).
double time_of_blow_up(double cubic, double x) {
    constexpr int steps = 20'000;
    double time = 0;
    for (int n = 0; n < steps; ++n) {
        const double w = (n + 0.5) / steps;
        const double s = 1 / (1 - w * w);
        const double speed = std::sqrt(-(s * s - 1) * (1 + cubic * x * x * (s * s + 1) / 2));
        time += 2 * w * s * s / speed / steps;
    }
    return time;
}

// Beyond the point where such springs push outward nothing holds the hammer, and no stop is met on the way.
TEST(EachStatus, NotFiniteIsSaidWhereSofteningSpringsThrowTheHammerBeyondAnyBound) {
    constexpr double cubic = -0.01;  // pushes outward beyond 10 A0
    constexpr double start = -30;
    for (const scene::ContactLaw<double>& stop :
         {scene::ContactLaw<double>(scene::Restitution<double>{0.98}),
          scene::ContactLaw<double>(paper_rig(beam_170mm, 2, 1).kelvin_voigt())}) {
        auto oscillator = paper_rig(beam_170mm, 2, 1);
        oscillator.contact = stop;
        oscillator.cubic = cubic;
        ASSERT_LT(time_of_blow_up(cubic, start), 3 * oscillator.period());
        for (const Engine engine : {Engine::cvode, Engine::arkode}) {
            const CellResult cell = find_steady_state(oscillator, {start - oscillator.gap, 0}, {},
                                                      {.engine = engine, .tolerance = 1e-9});
            EXPECT_EQ(cell.regime, Regime::failed);
            EXPECT_EQ(cell.status, Status::not_finite);
            EXPECT_LE(cell.cycles, 3);
        }
    }
}

// Without its cubic spring this cell settles in time; with it, errors first grow by e^20.
TEST(EachStatus, RoundingIsSaidWhereTheSecondSearchFindsIt) {
    const double frequency = 4.4642798737504297;
    const double gap = 0.64683353912512764;
    const auto oscillator = paper_rig(beam_170mm, frequency, gap);
    const CellResult without = find_steady_state(oscillator, start_at(oscillator), {});
    ASSERT_LT(without.sensitivity, 20);
    const CellResult cell = solved(238.2325, frequency, gap);
    EXPECT_EQ(cell.engine, Engine::exact);
    EXPECT_TRUE(same_label(cell, without));
    EXPECT_EQ(cell.status, Status::rounding);
    auto with_cubic = oscillator;
    with_cubic.cubic = paper_cubic;
    const CellResult with =
        find_steady_state(with_cubic, start_at(oscillator), {}, {.engine = Engine::split, .tolerance = 1e-9});
    EXPECT_GT(with.sensitivity, 20);
    EXPECT_NEAR(cell.sensitivity, with.sensitivity, 1);
}

// Newton's corrections end at rounding, about 1e-16 of the state, which exceeds the requested accuracy.
TEST(EachStatus, ImpreciseIsSaidWhereTheForceMayBeFurtherOffThanWasAskedFor) {
    const auto oscillator = paper_rig(beam_170mm, 2, 0.5);
    for (const double tolerance : {1e-9, 1e-18}) {
        const CellResult cell =
            find_steady_state(oscillator, start_at(oscillator), {}, {.tolerance = tolerance});
        ASSERT_EQ(cell.regime, Regime::periodic);
        EXPECT_EQ(cell.status, tolerance < 1e-16 ? Status::imprecise : Status::verified);
        const auto map = in_extended_precision(oscillator);
        LongState x(cell.orbit_displacement - oscillator.gap, cell.orbit_velocity);
        for (int n = 0; n < 400; ++n) x = map(x).end;
        trajectory::Recorder<long double> recorder;
        std::ignore = map(x, &recorder);
        const auto right = static_cast<double>(recorder.totals().peak_force());
        EXPECT_NEAR(cell.peak_force / right, 1, 1e-12);
    }
}

// A linear oscillator on its springs and the stop's: mean and amplitude of its force in closed form.
TEST(EachStatus, TheForceOfASustainedContactIsThatOfALinearOscillator) {
    const auto oscillator = paper_rig(beam_170mm, 0.5, -3.0);
    const CellResult cell = testing::solve(oscillator);
    ASSERT_EQ(cell.regime, Regime::sustained_contact);
    EXPECT_EQ(cell.status, Status::verified);
    const auto& stop = oscillator.kelvin_voigt();
    using Complex = std::complex<double>;
    const double eta = oscillator.frequency;
    const Complex dynamic_stiffness(1 + stop.stiffness - eta * eta,
                                    (2 * oscillator.damping_ratio + stop.damping) * eta);
    const Complex swing = eta * eta / dynamic_stiffness;
    const double depth = 3.0 / (1 + stop.stiffness);  // at rest
    const double force = stop.stiffness * depth + std::abs(swing * Complex(stop.stiffness, stop.damping * eta));
    EXPECT_NEAR(cell.peak_force / force, 1, 1e-9);
}

// Two neighbouring trajectories in extended precision, renormalised after every cycle.
TEST(EachStatus, TheExponentOfChaosIsTheRateAtWhichNeighboursPart) {
    const auto oscillator = paper_rig(beam_170mm, 2.88, 0.0);
    const CellResult cell = testing::solve(oscillator, 0, 0, {.max_cycles = 20'000, .chaos_cycles = 10'000});
    ASSERT_EQ(cell.regime, Regime::chaotic);
    EXPECT_EQ(cell.status, Status::verified);
    const auto map = in_extended_precision(oscillator);
    constexpr long double apart = 1e-11L;
    constexpr int cycles = 10'000;
    constexpr int blocks = 50;
    Eigen::ArrayXd rates = Eigen::ArrayXd::Zero(blocks);  // means over the cycles of a block
    LongState x = start_at(oscillator).cast<long double>();
    LongState step(apart, 0);
    for (int n = -100; n < cycles; ++n) {
        const LongState end = map(x).end;
        const LongState grown = map(LongState(x + step)).end - end;
        if (n >= 0)
            rates[n * blocks / cycles] += static_cast<double>(std::log(grown.norm() / apart)) * blocks / cycles;
        step = grown * (apart / grown.norm());
        x = end;
    }
    // Both are means over as many cycles of a chaotic motion.
    const double variance = (rates - rates.mean()).square().sum() / (blocks - 1) / blocks;
    const double error = std::sqrt(2 * variance);
    EXPECT_LT(error, 0.06 * cell.lyapunov);
    EXPECT_NEAR(cell.lyapunov, rates.mean(), 4 * error);
    EXPECT_EQ(cell.impacts, 0);
}

TEST(EachStatus, ChaosThatHadTooFewCyclesIsUnresolved) {
    const auto oscillator = paper_rig(beam_170mm, 2.88, 0.0);
    const CellResult cell = testing::solve(oscillator, 0, 0, {.max_cycles = 900, .chaos_cycles = 10'000});
    EXPECT_EQ(cell.regime, Regime::unresolved);
    EXPECT_EQ(cell.status, Status::chaotic_so_far);
    EXPECT_EQ(cell.observed_cycles, 900);
}

// A start behind a rigid stop has no motion.
TEST(EachStatus, AStartInsideARigidStopIsSolversFailure) {
    auto oscillator = paper_rig(beam_170mm, 2, 0.5);
    oscillator.contact = scene::Restitution<double>{0.6};
    const CellResult inside = testing::solve(oscillator, 0.6, 0);
    EXPECT_EQ(inside.regime, Regime::failed);
    EXPECT_EQ(inside.status, Status::solver_failed);
    EXPECT_TRUE(std::isnan(inside.peak_force));
    EXPECT_EQ(testing::solve(oscillator, 0.4, 0).regime, Regime::periodic);
}

}  // namespace
}  // namespace peterka::regime
