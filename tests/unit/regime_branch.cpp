// Branches of a sweep: jumps where folds and edges are known independently, agreement where only one
// attractor exists, and samples of the motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "job/axis.hpp"
#include "regime/branch.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::regime {
namespace {

using job::Direction;

job::Job sweep_job(double gap, double from, double to, std::int64_t points, Direction direction) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = from, .to = to, .points = points};
    job.sweep = {.gap_ratio = {gap}, .direction = direction};
    return job;
}

std::vector<BranchPoint> branch(const job::Job& job) {
    const scene::Scene scene(job);
    std::vector<BranchPoint> points = follow_branch(scene, 0, [] {});
    mark_jumps(scene, 0, points, [] {});
    return points;
}

bool is(const CellResult& cell, int impacts, int period) {
    return cell.regime == Regime::periodic && cell.impacts == impacts && cell.period == period;
}

std::vector<std::size_t> jumps(const std::vector<BranchPoint>& points) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].cell.jump) columns.push_back(i);
    }
    return columns;
}

// At 1.5 A0, z = 1/1 ends in a fold at 1.862464993 (Newton's method on the
// orbit, in extended precision), and no impact begins to touch where the free
// amplitude reaches the gap. In between the history decides (hysteresis).
TEST(Branch, JumpsAtTheFoldGoingUpAndAtTheEdgeOfNoImpactGoingDown) {
    constexpr double gap = 1.5;
    constexpr double fold = 1.862464993;
    constexpr double start = 1.6;  // too close to resonance for no impact: both branches follow z = 1/1
    const job::Job up = sweep_job(gap, start, 1.9, 241, Direction::up);
    const job::Job down = sweep_job(gap, start, 1.9, 241, Direction::down);
    const auto rising = branch(up);
    const auto falling = branch(down);

    const auto fold_at = jumps(rising);
    ASSERT_EQ(fold_at.size(), 1U);
    EXPECT_LT(job::axis_value(up.columns, static_cast<std::int64_t>(fold_at[0]) - 1), fold);
    EXPECT_GT(job::axis_value(up.columns, static_cast<std::int64_t>(fold_at[0])), fold);
    EXPECT_TRUE(is(rising[fold_at[0] - 1].cell, 1, 1));
    EXPECT_EQ(rising[fold_at[0]].cell.regime, Regime::no_impact);

    const auto edge_at = jumps(falling);
    ASSERT_EQ(edge_at.size(), 1U);
    const auto free_at = [&](std::size_t column) {
        return testing::free_amplitude(testing::paper_rig(
            testing::beam_170mm, job::axis_value(down.columns, static_cast<std::int64_t>(column)), gap));
    };
    // a step's own transient may touch the stop one step early
    EXPECT_GT(free_at(edge_at[0] - 1), gap);
    EXPECT_LT(free_at(edge_at[0] + 1), gap);
    EXPECT_TRUE(is(falling[edge_at[0]].cell, 1, 1));
    EXPECT_LT(edge_at[0], fold_at[0]);
}

TEST(Branch, DoublesItsPeriodWithoutAJump) {
    constexpr double doubling = 2.659361979;  // of z = 1/1 at gap 0, where a multiplier passes -1
    for (const Direction direction : {Direction::up, Direction::down}) {
        const job::Job job = sweep_job(0, 2.64, 2.68, 41, direction);
        const auto points = branch(job);
        EXPECT_EQ(jumps(points), std::vector<std::size_t>());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double frequency = job::axis_value(job.columns, static_cast<std::int64_t>(i));
            const bool single = frequency < doubling;
            EXPECT_TRUE(is(points[i].cell, single ? 1 : 2, single ? 1 : 2)) << frequency;
        }
    }
}

TEST(Branch, UpIsDownWhereOneAttractorIsAllThereIs) {
    const auto rising = branch(sweep_job(0, 1.4, 2.4, 51, Direction::up));
    const auto falling = branch(sweep_job(0, 1.4, 2.4, 51, Direction::down));
    for (std::size_t i = 0; i < rising.size(); ++i) {
        const CellResult& up = rising[i].cell;
        const CellResult& down = falling[i].cell;
        ASSERT_TRUE(is(up, 1, 1));
        ASSERT_TRUE(is(down, 1, 1));
        EXPECT_NEAR(up.peak_force, down.peak_force, 1e-9 * up.peak_force);
        EXPECT_LT((*rising[i].motion.end - *falling[i].motion.end).norm(), 1e-9);
    }
}

TEST(Branch, WithIndependentStartsIsARowOfAMap) {
    const job::Job job = sweep_job(0.5, 0.6, 4.4, 39, Direction::independent);
    const auto points = branch(job);
    job::Job map = job;
    map.kind = job::Kind::map;
    map.rows = {.from = 0.5, .to = 1.5, .points = 2};
    const scene::Scene plane(map);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const CellResult cell = solve_cell(plane, 0, static_cast<std::int64_t>(i));
        EXPECT_EQ(points[i].cell.regime, cell.regime);
        EXPECT_EQ(points[i].cell.impacts, cell.impacts);
        EXPECT_EQ(points[i].cell.period, cell.period);
        EXPECT_EQ(points[i].cell.cycles, cell.cycles);
        if (!std::isnan(cell.peak_force)) {
            EXPECT_NEAR(points[i].cell.peak_force, cell.peak_force, 1e-12 * (1 + cell.peak_force));
        }
    }
}

// The absolute velocity is kept when the cart's speed increases: x' = delta' + eta.
TEST(Branch, HandsOnTheAbsoluteState) {
    const job::Job job = sweep_job(0, 2.0, 2.5, 2, Direction::up);
    const auto points = branch(job);
    const scene::Scene scene(job);
    scene::Cell second = scene.cell(0, 1);
    second.start = *points[0].motion.end;
    second.start[1] += 2.0 - 2.5;
    const CellResult by_hand = find_steady_state(second.oscillator, second.start, job::SteadyState{});
    EXPECT_EQ(points[1].cell.cycles, by_hand.cycles);
    EXPECT_EQ(points[1].cell.peak_force, by_hand.peak_force);
}

TEST(Branch, SamplesAreTheWholeOrbit) {
    job::Job job = sweep_job(0, 2.0, 3.1, 12, Direction::independent);
    job.output.fields = {job::OptionalField::orbit, job::OptionalField::impact_speed};
    int doubled = 0;
    for (const auto& [cell, motion, gap] : branch(job)) {
        if (cell.regime != Regime::periodic) continue;
        ASSERT_EQ(motion.stroboscopic.values().size(), static_cast<std::size_t>(cell.period));
        ASSERT_EQ(motion.touches.values().size(), static_cast<std::size_t>(cell.impacts));
        EXPECT_EQ(motion.stroboscopic.values().front()[0], cell.orbit_displacement);  // gap 0
        EXPECT_EQ(motion.stroboscopic.values().front()[1], cell.orbit_velocity);
        const auto touches = motion.touches.values();
        const auto fastest = std::ranges::max_element(touches, {}, &trajectory::Touch<double>::speed);
        EXPECT_NEAR(fastest->speed, cell.impact_speed, 1e-12 * cell.impact_speed);
        doubled += cell.period > 1 ? 1 : 0;
    }
    EXPECT_GT(doubled, 2);
}

// On an orbit without a cubic spring, a state at first touch and one at phase 0 lie on the same free flight:
// its closed form maps one to the other.
TEST(Branch, TouchesLieOnTheOrbit) {
    const job::Job job = sweep_job(0.5, 2.0, 2.2, 2, Direction::up);
    const auto points = branch(job);
    const scene::Scene scene(job);
    const auto oscillator = scene.cell(0, 0).oscillator;
    ASSERT_TRUE(is(points[0].cell, 1, 1));
    const auto touch = points[0].motion.touches.values().front();
    const double phase = touch.phase;
    ASSERT_GT(phase, 0);
    ASSERT_LT(phase, 2 * std::numbers::pi);
    // u = e^(-zeta t) (a cos w t + b sin w t) + P sin(eta t - lag), with the flight's start at phase 0
    const auto flight_to = [&](const scene::State<double>& from) {
        const double eta = oscillator.frequency;
        const double zeta = oscillator.damping_ratio;
        const double amplitude = testing::free_amplitude(oscillator);
        const double lag = std::atan2(2 * zeta * eta, 1 - eta * eta);
        const double w = std::sqrt(1 - zeta * zeta);
        const double a = from[0] + oscillator.gap + amplitude * std::sin(lag);
        const double b = (from[1] - amplitude * eta * std::cos(lag) + zeta * a) / w;
        const double t = phase / eta;
        return std::exp(-zeta * t) * (a * std::cos(w * t) + b * std::sin(w * t)) +
               amplitude * std::sin(phase - lag);
    };
    EXPECT_NEAR(flight_to(points[0].motion.stroboscopic.values().front()), oscillator.gap, 1e-9);
}

TEST(Branch, KeepsAsManySamplesAsThereIsRoomFor) {
    job::Job job = sweep_job(0, 2.8, 2.9, 5, Direction::up);
    job.sweep.samples = 1;
    for (const auto& [cell, motion, gap] : branch(job)) {
        EXPECT_EQ(motion.stroboscopic.values().size(), 1U);
        EXPECT_EQ(motion.touches.values().size(), 1U);
    }
}

TEST(Branch, GoesOnFromWhereAMotionWithoutAProofEnded) {
    job::Job job = sweep_job(0, 2.0, 2.5, 3, Direction::up);
    job.steady_state.max_cycles = 3;  // too few for any proof
    const auto points = branch(job);
    ASSERT_EQ(points[0].cell.regime, Regime::unresolved);
    ASSERT_TRUE(points[0].motion.end.has_value());
    scene::Cell second = scene::Scene(job).cell(0, 1);
    second.start = *points[0].motion.end;
    second.start[1] -= 0.25;
    EXPECT_EQ(points[1].cell.peak_force,
              find_steady_state(second.oscillator, second.start, job.steady_state).peak_force);
}

TEST(Branch, AFailedPointIsData) {
    job::Job job = sweep_job(0, 2.0, 2.5, 3, Direction::up);
    job.contact = job::KelvinVoigt{5.5e6, 1e30};  // too many contacts in one cycle
    for (const auto& [cell, motion, gap] : branch(job)) {
        EXPECT_EQ(cell.regime, Regime::failed);
        EXPECT_FALSE(motion.end.has_value());
        EXPECT_TRUE(motion.stroboscopic.values().empty());
        EXPECT_FALSE(cell.jump);
    }
}

TEST(Branch, GivesUpWhenAskedTo) {
    int looks = 0;
    const scene::Scene scene(sweep_job(0, 1.4, 2.4, 51, Direction::up));
    const auto look = [&] {
        if (++looks == 4) throw Stopped();
    };
    EXPECT_THROW((void)follow_branch(scene, 0, look), Stopped);
    EXPECT_EQ(looks, 4);
}

std::vector<BranchPoint> with_forces(const std::vector<double>& forces, Regime regime) {
    std::vector<BranchPoint> points;
    for (const double force : forces) {
        points.push_back({{.regime = regime, .peak_force = force}, SteadyMotion(1)});
    }
    return points;
}

std::vector<std::size_t> jumps_of(const std::vector<double>& forces, Regime regime,
                                  Direction direction = Direction::up) {
    auto points = with_forces(forces, regime);
    mark_jumps(points, direction);
    return jumps(points);
}

TEST(Jumps, AreMarkedWhereTheDirectionLands) {
    const std::vector<double> forces{100, 98, 0, 0, 1};
    EXPECT_EQ(jumps_of(forces, Regime::periodic), std::vector<std::size_t>{2});
    EXPECT_EQ(jumps_of(forces, Regime::periodic, Direction::down), std::vector<std::size_t>{1});
}

TEST(Jumps, AreOfImpactSpeedsOnARigidStopWhichHasNoForce) {
    auto points = with_forces({unknown, unknown, 0, unknown, unknown}, Regime::periodic);
    points[2].cell.regime = Regime::no_impact;
    for (const std::size_t i : {0, 1, 3, 4}) points[i].cell.impact_speed = i < 2 ? 1.0 : 0.01;
    mark_jumps(points, Direction::up);
    EXPECT_EQ(jumps(points), std::vector<std::size_t>{2});
}

TEST(Jumps, AreNoSteepSlopes) {
    EXPECT_EQ(jumps_of({0, 20, 40, 60, 80, 100}, Regime::periodic), std::vector<std::size_t>());
    EXPECT_EQ(jumps_of({0, 4, 8, 12, 16, 20}, Regime::periodic), std::vector<std::size_t>());
}

// The way into a fold is steep itself. Of 3/2, to which no 1/1 changes gradually; a doubled period may do so.
TEST(Jumps, AreToldAfterASteepWayToAnotherPeriod) {
    const auto marked = [](int impacts, int period, double before) {
        auto points = with_forces({27, 26, 25, before, 19.4, 15, 15, 15, 15}, Regime::periodic);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].cell.impacts = i < 5 ? impacts : 1;
            points[i].cell.period = i < 5 ? period : 1;
        }
        mark_jumps(points, Direction::up);
        return jumps(points);
    };
    EXPECT_EQ(marked(3, 2, 22), std::vector<std::size_t>{5});
    EXPECT_EQ(marked(3, 2, 23.9), std::vector<std::size_t>());  // no less steep before
    EXPECT_EQ(marked(2, 2, 22), std::vector<std::size_t>());
    EXPECT_EQ(marked(2, 1, 22), std::vector<std::size_t>());
}

// A motion without impacts that comes to graze each second cycle.
TEST(Jumps, AreNoneWhereImpactsBegin) {
    auto points = with_forces({0, 0, 0, 0, 0.0171, 0.0270, 0.0338, 0.0395}, Regime::periodic);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].cell.regime = i < 4 ? Regime::no_impact : Regime::periodic;
        points[i].cell.impacts = i < 4 ? 0 : 1;
        points[i].cell.period = i < 4 ? 1 : 2;
    }
    mark_jumps(points, Direction::up);
    EXPECT_EQ(jumps(points), std::vector<std::size_t>());
}

// A period doubling just after a point: the blow grows as the square root of the distance.
TEST(Jumps, AreNoneAtAnOnsetWithASquareRoot) {
    std::vector<double> forces(5, 1.0);
    for (int n = 0; n < 5; ++n) forces.push_back(1 + std::sqrt(n + 0.97));
    auto points = with_forces(forces, Regime::periodic);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].cell.impacts = i < 5 ? 1 : 2;
        points[i].cell.period = i < 5 ? 2 : 4;
    }
    mark_jumps(points, Direction::up);
    EXPECT_EQ(jumps(points), std::vector<std::size_t>());
}

TEST(Jumps, AreNoneAmongMotionsWithoutAPeriodNorNextToAFailure) {
    EXPECT_EQ(jumps_of({100, 30, 80}, Regime::chaotic), std::vector<std::size_t>());
    EXPECT_EQ(jumps_of({100, unknown, 80}, Regime::periodic), std::vector<std::size_t>());
}

TEST(Jumps, AreNoneAtWindowsInChaos) {
    auto points = with_forces({100, 90, 30, 80, 90, 85, 40, 40, 40, 40}, Regime::chaotic);
    points[2].cell.regime = Regime::periodic;  // one point wide
    for (std::size_t i = 6; i < points.size(); ++i) points[i].cell.regime = Regime::periodic;
    mark_jumps(points, Direction::up);
    EXPECT_EQ(jumps(points), std::vector<std::size_t>{6});
}

// As where a motion whose impacts change one by one, while its force goes on evenly, ends in chaos.
TEST(Jumps, StandOutWhereTheMotionBesideThemLastedNotLong) {
    const auto marked = [](double before_last, std::size_t chaotic) {
        auto points =
            with_forces({45, 42, 38, 37, 35, 33, before_last, 85, 85.2, 76, 84, 74}, Regime::periodic);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].cell.impacts = static_cast<std::int32_t>(i);  // no label lasts
            if (i >= chaotic) points[i].cell.regime = Regime::chaotic;
        }
        mark_jumps(points, Direction::up);
        return jumps(points);
    };
    EXPECT_EQ(marked(30, 7), std::vector<std::size_t>{7});
    EXPECT_EQ(marked(30, 0), std::vector<std::size_t>());  // no motion with a period begins or ends
    EXPECT_EQ(marked(6, 7), std::vector<std::size_t>{7});
    EXPECT_EQ(marked(60, 7), std::vector<std::size_t>());  // 27 and 25: neither stands out
}

}  // namespace
}  // namespace peterka::regime
