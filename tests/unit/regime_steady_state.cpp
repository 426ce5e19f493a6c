// The regimes: each with its proof, and motions that must not be mistaken for one.
#include "regime/steady_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "regime/recurrence.hpp"
#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::regime {
namespace {

using testing::beam_150mm;
using testing::beam_170mm;
using testing::paper_rig;
using testing::solve;

TEST(Regimes, MultiplierNearMinusOneDoesNotDoubleThePeriod) {
    const CellResult cell = solve(paper_rig(beam_170mm, 0.95, 2.5625));
    EXPECT_EQ(cell.impacts, 1);
    EXPECT_EQ(cell.period, 1);
}

TEST(Regimes, PeriodIsNotReduced) {
    const CellResult cell = solve(paper_rig(beam_170mm, 12.25 / 4.5, 0));  // the paper's alternating impacts
    EXPECT_EQ(cell.impacts, 2);
    EXPECT_EQ(cell.period, 2);
}

TEST(Regimes, ShortHopsCount) {
    const CellResult cell = solve(paper_rig(beam_170mm, 3.1, 0));
    EXPECT_EQ(cell.impacts, 3);
    EXPECT_EQ(cell.period, 2);
}

TEST(Regimes, StartDecidesWhereTwoAttractorsExist) {
    const auto oscillator = paper_rig(beam_150mm, 1.80, 1.60);
    std::map<Regime, int> found;
    for (double velocity = -5; velocity <= 5; velocity += 1) {
        const CellResult cell = solve(oscillator, -1, velocity);
        ++found[cell.regime];
        if (cell.regime == Regime::periodic) {
            EXPECT_EQ(std::make_pair(cell.impacts, cell.period), std::make_pair(1, 1));
        }
    }
    EXPECT_GT(found[Regime::no_impact], 0);
    EXPECT_GT(found[Regime::periodic], 0);
    EXPECT_EQ(found[Regime::no_impact] + found[Regime::periodic], 11);
}

// Followed explicitly, far beyond the cycle that proves that no further impact occurs.
TEST(Regimes, LastImpactIsTheLastCycleWithAContact) {
    const auto oscillator = paper_rig(beam_150mm, 1.80, 2.2);
    const trajectory::ExactCycleMap<double> map(oscillator);
    std::set<std::int32_t> found;
    for (double velocity = -6; velocity <= 6; velocity += 0.5) {
        const CellResult cell = solve(oscillator, -1, velocity);
        ASSERT_EQ(cell.regime, Regime::no_impact);
        std::int32_t last = 0;
        scene::State<double> x = testing::start_at(oscillator, -1, velocity);
        for (std::int32_t cycle = 1; cycle <= 2000; ++cycle) {
            const auto passage = map(x);
            if (passage.touched) last = cycle;
            x = passage.end;
        }
        if (cell.sensitivity > 15) continue;  // transient chaos: the cycle depends on rounding
        EXPECT_EQ(cell.last_impact, last) << velocity;
        found.insert(last);
    }
    EXPECT_GT(found.size(), 5);
    EXPECT_EQ(solve(paper_rig(beam_150mm, 1.80, 5)).last_impact, 0);
    EXPECT_EQ(solve(paper_rig(beam_170mm, 2, 0)).last_impact, goes_on);
}

TEST(Regimes, ChaosHasAPositiveExponentAndAWindow) {
    const CellResult cell = solve(paper_rig(beam_170mm, 2.88, 0.0));
    ASSERT_EQ(cell.regime, Regime::chaotic);
    EXPECT_GE(cell.cycles, 300);  // the steady free motion reaches the stop: impacts never end
    EXPECT_GT(cell.lyapunov, 0);
    EXPECT_GT(cell.sensitivity, 20);
    EXPECT_GT(cell.peak_force, 0);
    EXPECT_GT(cell.impact_rate, 0.4);
    EXPECT_EQ(cell.impacts, 0);
    EXPECT_EQ(cell.period, 0);
}

// Where the hammer may become free for good, chaos is declared later: most of it is transient.
TEST(Regimes, ChaosThatMayEndIsWatchedLonger) {
    int chaotic = 0;
    for (double gap = 1.2; gap < 1.7; gap += 0.02) {
        const auto oscillator = paper_rig(beam_170mm, 3.8, gap);
        const CellResult cell = solve(oscillator);
        if (cell.regime != Regime::chaotic) continue;
        ++chaotic;
        EXPECT_GE(cell.cycles, testing::free_amplitude(oscillator) < gap ? 1000 : 300) << gap;
    }
    EXPECT_GT(chaotic, 0);
}

// Slow transients with a slightly positive exponent over the first thousand cycles: 2/4 and 2/2 in the end.
TEST(Regimes, SlowDriftIsNotChaos) {
    const auto drifting = paper_rig(beam_150mm, 0.8992172211350293, 2.495107632093933);
    const CellResult doubled = solve(drifting);
    EXPECT_EQ(std::make_pair(doubled.impacts, doubled.period), std::make_pair(2, 4));
    const CellResult alternating = solve(paper_rig(beam_170mm, 0.5 + 4.0 * 10 / 99, 5.0 * 37 / 99));
    EXPECT_EQ(std::make_pair(alternating.impacts, alternating.period), std::make_pair(2, 2));
}

// A search orders several cycles at a time, unless it needs each one's largest force.
TEST(Regimes, ManyCyclesAtATimeSayWhatSingleOnesSay) {
    std::mt19937 random(6);
    std::map<Regime, int> found;
    int went_ahead = 0;
    int settled_early = 0;
    for (int n = 0; n < 600; ++n) {
        auto oscillator = paper_rig(beam_170mm, std::uniform_real_distribution(2.6, 4.4)(random),
                                    std::uniform_real_distribution(0.0, 1.0)(random));
        if (n % 3 == 2) oscillator.contact = scene::Restitution<double>{0.3 + 0.001 * n};
        const auto detail = n % 3 == 1 ? trajectory::Detail::contacts : trajectory::Detail::force;
        job::SteadyState budget;
        if (n % 2 == 1)
            budget = {.max_cycles = 186 + n % 14, .max_period = 64, .chaos_cycles = 150};  // any turn
        if (n % 5 == 4) budget.max_cycles = 11 + n % 23;                                   // before most settle
        const auto start = testing::start_at(oscillator);
        const CellResult many = find_steady_state(oscillator, start, budget, {}, {.detail = detail});
        const CellResult single =
            find_steady_state(oscillator, start, budget, {}, {.detail = detail, .force_per_cycle = true});
        EXPECT_TRUE(same_label(many, single)) << n;
        EXPECT_EQ(many.status, single.status) << n;
        for (const auto number : {&CellResult::peak_force, &CellResult::impact_rate, &CellResult::lyapunov,
                                  &CellResult::impulse, &CellResult::sensitivity}) {
            EXPECT_EQ(std::isnan(many.*number), std::isnan(single.*number)) << n;
            if (!std::isnan(many.*number)) {
                EXPECT_EQ(many.*number, single.*number) << n;
            }
        }
        EXPECT_GE(many.cycles, single.cycles) << n;
        EXPECT_LT(many.cycles, single.cycles + 25) << n;
        if (single.cycles <= Recurrence::early_cycles) {
            EXPECT_EQ(many.cycles, single.cycles) << n;  // cycles not examined do not count
            ++settled_early;
        }
        went_ahead += many.cycles > single.cycles ? 1 : 0;
        ++found[many.regime];
    }
    EXPECT_GT(went_ahead, 0);
    EXPECT_GT(settled_early, 100);
    EXPECT_GT(found[Regime::periodic], 0);
    EXPECT_GT(found[Regime::chaotic], 0);
    EXPECT_GT(found[Regime::unresolved], 0);
}

TEST(Regimes, BudgetEndsInUnresolved) {
    const CellResult cell = solve(paper_rig(beam_170mm, 2.0, 0.0), 0, 0, {.max_cycles = 2});
    EXPECT_EQ(cell.regime, Regime::unresolved);
    EXPECT_EQ(cell.status, Status::budget);
    EXPECT_EQ(cell.impacts, 0);
    EXPECT_EQ(cell.period, 0);
    EXPECT_GT(cell.peak_force, 0);
}

TEST(Regimes, NothingSettlesWithoutDissipation) {
    auto oscillator = paper_rig(beam_170mm, 1.7, 0.2);
    oscillator.damping_ratio = 0;
    oscillator.kelvin_voigt().damping = 0;
    const CellResult cell = solve(oscillator);
    EXPECT_EQ(cell.regime, Regime::unresolved);
    EXPECT_EQ(cell.status, Status::conservative);
}

TEST(Regimes, UndampedResonanceIsNotHidden) {
    auto oscillator = paper_rig(beam_170mm, 1.0, 50.0);
    oscillator.damping_ratio = 0;  // grows until it reaches even this stop
    const CellResult cell = solve(oscillator);
    EXPECT_EQ(cell.regime == Regime::periodic || cell.regime == Regime::chaotic, true);
    EXPECT_GT(cell.peak_force, 0);
}

TEST(Regimes, PreloadedHammerNeverSeparates) {
    const auto oscillator = paper_rig(beam_170mm, 0.5, -3.0);
    const CellResult cell = solve(oscillator);
    EXPECT_EQ(cell.regime, Regime::sustained_contact);
    EXPECT_EQ(cell.impacts, 0);
    EXPECT_EQ(cell.period, 1);
    // quasi-static: the stop carries the preload and nearly all of the cart's inertia force
    EXPECT_NEAR(cell.peak_force, 3.0 + 0.25, 1e-3);
}

TEST(Regimes, NumbersOutOfRangeAreAFailedCell) {
    const CellResult cell = solve(paper_rig(beam_170mm, 2.0, 0.0), 1e306, 1e308);
    EXPECT_EQ(cell.regime, Regime::failed);
    EXPECT_EQ(cell.status, Status::not_finite);
    EXPECT_TRUE(std::isnan(cell.peak_force));
}

TEST(Regimes, NoRandomCellFails) {
    std::mt19937 random(2026);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(0, 5);
    for (int n = 0; n < 40'000; ++n) {
        const auto oscillator = paper_rig(beam_170mm, frequency(random), gap(random));
        const CellResult cell = solve(oscillator, 0, 0, {.max_cycles = 200, .chaos_cycles = 200});
        ASSERT_NE(cell.regime, Regime::failed) << oscillator.frequency << " " << oscillator.gap;
        if (cell.regime == Regime::no_impact) {
            ASSERT_GE(oscillator.gap, testing::free_amplitude(oscillator));
        }
    }
}

// Even for extreme rigs every cell ends in a claim or in a stated reason: under preload, an elastic stop
// stiffer than steel lets the hammer oscillate more often per cycle than can be followed.
TEST(Regimes, ExtremeScenesEnd) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    std::map<Regime, int> found;
    for (int n = 0; n < 400; ++n) {
        scene::Oscillator<double> oscillator;
        oscillator.damping_ratio = n % 10 == 0 ? 0 : std::pow(10.0, -6 + 6.3 * share(random));
        oscillator.kelvin_voigt().stiffness = std::pow(10.0, -2 + 17 * share(random));
        const double contact_damping_ratio = n % 7 == 0 ? 0 : std::pow(10.0, -3 + 5 * share(random));
        oscillator.kelvin_voigt().damping =
            2 * contact_damping_ratio * std::sqrt(oscillator.kelvin_voigt().stiffness);
        oscillator.frequency = std::pow(10.0, -2 + 3.7 * share(random));
        oscillator.gap = n % 5 == 0 ? 0 : 6 * (share(random) - 0.3);
        const double spread = n % 11 == 0 ? 1e6 : 3;
        const CellResult cell = find_steady_state(
            oscillator, {spread * (share(random) - 0.5) - oscillator.gap, spread * (share(random) - 0.5)},
            {.max_cycles = 1000});
        ++found[cell.regime];
        if (cell.regime == Regime::failed) {
            EXPECT_EQ(cell.status, Status::too_many_events) << n;
            EXPECT_EQ(oscillator.kelvin_voigt().damping, 0) << n;
        } else {
            EXPECT_TRUE(std::isfinite(cell.peak_force)) << n;
        }
    }
    EXPECT_LT(found[Regime::failed], 8);
    EXPECT_GT(found[Regime::no_impact], 0);
    EXPECT_GT(found[Regime::periodic], 0);
    EXPECT_GT(found[Regime::sustained_contact], 0);
}

// Shares of the regimes over the paper's window, from 20,000-cycle runs of another program.
TEST(Regimes, ShareTheWindowAsKnown) {
    constexpr int points = 200;
    std::map<Regime, int> cells;
    std::map<std::pair<int, int>, int> orbits;
    for (int row = 0; row < points; ++row) {
        for (int column = 0; column < points; ++column) {
            const CellResult cell =
                solve(paper_rig(beam_170mm, 0.5 + 4.0 * column / (points - 1), 5.0 * row / (points - 1)));
            ++cells[cell.regime];
            ++orbits[{cell.impacts, cell.period}];
        }
    }
    const auto percent = [](int count) { return 100.0 * count / (points * points); };
    // Within half a percent: chaotic transients towards no impact (0.35 % of the cells) outlive 1000 cycles
    // here.
    EXPECT_NEAR(percent(cells[Regime::no_impact]), 61.7, 0.5);
    EXPECT_NEAR(percent(cells[Regime::periodic]), 35.6, 0.5);
    EXPECT_NEAR(percent(cells[Regime::chaotic]), 2.7, 0.5);
    EXPECT_NEAR(percent(orbits[{1, 1}]), 20.4, 0.5);
    EXPECT_NEAR(percent(orbits[{1, 2}]), 8.6, 0.5);
    EXPECT_EQ(cells[Regime::failed], 0);
    EXPECT_LT(percent(cells[Regime::unresolved]), 0.2);
}

}  // namespace
}  // namespace peterka::regime
