#include "findings/sweep_findings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "report/summary_parts.hpp"
#include "rig.hpp"

namespace peterka {
namespace {

using quantities::StoredCell;
using regime::Regime;

StoredCell orbit(int impacts, int period, double force, bool jump = false) {
    return {
        .regime = Regime::periodic, .jump = jump, .impacts = impacts, .period = period, .peak_force = force};
}
StoredCell free_motion(bool jump = false) {
    return {.regime = Regime::no_impact, .jump = jump, .period = 1, .peak_force = 0};
}
StoredCell chaos(double force) {
    return {.regime = Regime::chaotic, .peak_force = force};
}

StoredCell rigid_orbit(double speed, bool jump = false) {
    StoredCell cell = orbit(1, 1, std::nan(""), jump);
    cell.impact_speed = speed;
    return cell;
}

BranchFindings rising() {
    return find_in_branch({0, job::Direction::up}, {orbit(1, 1, 40), orbit(1, 1, 50), orbit(1, 1, 60),
                                                    free_motion(true), chaos(70), orbit(1, 2, 20, true)});
}
BranchFindings falling() {
    return find_in_branch({0, job::Direction::down}, {orbit(1, 1, 40, true), free_motion(), free_motion(),
                                                      free_motion(), chaos(65), orbit(1, 2, 20)});
}

TEST(SweepFindings, TheLargestForceOfOneImpactACycle) {
    EXPECT_EQ(rising().one_to_one, 2);
    EXPECT_EQ(rising().largest, 4);
    EXPECT_EQ(find_in_branch({0, job::Direction::up}, {free_motion(), chaos(3)}).one_to_one, std::nullopt);
}

TEST(SweepFindings, AResonanceIsAMaximumInsideTheBand) {
    const auto around = [](job::Direction direction, std::vector<StoredCell> cells) {
        return find_in_branch({0, direction}, std::move(cells)).around_one_to_one;
    };
    using enum job::Direction;
    const auto inside = around(up, {orbit(1, 1, 40), orbit(1, 1, 60), orbit(1, 1, 50)});
    EXPECT_TRUE(inside.inside());
    const auto rises = around(up, {orbit(1, 1, 40), orbit(1, 1, 50)});
    EXPECT_EQ(rises.above, Side::end_of_sweep);
    EXPECT_EQ(around(up, {orbit(1, 1, 40), orbit(2, 2, 50)}).above, Side::other_band);
    EXPECT_EQ(rising().around_one_to_one.above, Side::jump);
    EXPECT_EQ(rising().around_one_to_one.below, Side::own_band);
    // for a falling branch, a jump is marked on its lower side
    EXPECT_EQ(around(down, {orbit(1, 1, 40), orbit(1, 1, 50, true), free_motion()}).above, Side::jump);
    EXPECT_EQ(around(down, {orbit(1, 1, 40, true), orbit(1, 1, 50), free_motion()}).below, Side::jump);
    // the same band continues beyond a jump
    EXPECT_EQ(around(up, {orbit(1, 1, 10), orbit(1, 1, 50, true), orbit(1, 1, 40)}).below, Side::jump);
}

TEST(SweepFindings, JumpsFollowTheDirection) {
    ASSERT_EQ(rising().jumps.size(), 2U);
    EXPECT_EQ(rising().jumps[0].from, 2);
    EXPECT_EQ(rising().jumps[0].to, 3);
    ASSERT_EQ(falling().jumps.size(), 1U);
    EXPECT_EQ(falling().jumps[0].from, 1);
    EXPECT_EQ(falling().jumps[0].to, 0);
}

TEST(SweepFindings, BandsAndSharesCoverTheBranch) {
    const BranchFindings found = rising();
    ASSERT_EQ(found.bands.size(), 4U);
    EXPECT_EQ(found.bands[0].first, 0);
    EXPECT_EQ(found.bands[0].last, 2);
    ASSERT_EQ(found.points.size(), 4U);
    EXPECT_EQ(found.points[0].first, motion_class(orbit(1, 1, 1)));
    EXPECT_EQ(found.points[0].second, 3);
}

TEST(SweepFindings, HysteresisIsWhereSteadyMotionsDiffer) {
    const auto found = find_hysteresis(rising(), falling());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].first, 1);
    EXPECT_EQ(found[0].last, 2);
    EXPECT_TRUE(find_hysteresis(rising(), rising()).empty());
}

TEST(SweepFindings, EachStretchOfHysteresisIsFound) {
    const StoredCell unresolved{.regime = Regime::unresolved};
    const auto branch = [](std::vector<StoredCell> cells) {
        return find_in_branch({0, job::Direction::up}, std::move(cells));
    };
    const auto ends = [&](const std::vector<StoredCell>& up, const std::vector<StoredCell>& down) {
        std::vector<std::pair<std::int64_t, std::int64_t>> found;
        for (const Stretch& each : find_hysteresis(branch(up), branch(down)))
            found.emplace_back(each.first, each.last);
        return found;
    };
    using Ends = std::vector<std::pair<std::int64_t, std::int64_t>>;
    const StoredCell one = orbit(1, 1, 40);
    const StoredCell two = orbit(2, 1, 50);
    const StoredCell other = orbit(1, 1, 41);  // by 2.4 %
    EXPECT_EQ(ends({one, one, one, one, one, one, one}, {two, two, one, other, two, one, two}),
              (Ends{{0, 1}, {3, 4}, {6, 6}}));
    EXPECT_EQ(ends({one, one, one, one}, {two, unresolved, other, one}), (Ends{{0, 2}}));
    EXPECT_EQ(ends({one, one, one, one}, {unresolved, two, two, unresolved}), (Ends{{1, 2}}));
    EXPECT_EQ(ends({one, unresolved, one}, {two, unresolved, one}), (Ends{{0, 0}}));
    EXPECT_EQ(ends({one, one, one, one, one}, {two, two, chaos(60), two, two}), (Ends{{0, 4}}));
    EXPECT_EQ(ends({one, one, chaos(50), one}, {two, two, chaos(60), two}), (Ends{{0, 1}, {3, 3}}));
    EXPECT_EQ(ends({free_motion(), chaos(50), one}, {chaos(50), free_motion(), one}), (Ends{{0, 1}}));
}

// Which has no peak force.
TEST(SweepFindings, HysteresisOnARigidStopIsThatOfTheImpactSpeed) {
    const auto branch = [](double speed) {
        return find_in_branch({0, job::Direction::up}, {rigid_orbit(speed), rigid_orbit(speed)});
    };
    const auto found = find_hysteresis(branch(1), branch(1.02));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].last, 1);
    EXPECT_TRUE(find_hysteresis(branch(1), branch(1.005)).empty());
}

TEST(SweepSummary, TellsResonanceJumpsHysteresisAndShares) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.0, .to = 2.0, .points = 6};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::both};
    const std::vector<BranchFindings> branches{rising(), falling()};
    const std::string text = sweep_summary(scene::Scene(job), branches);
    for (const char* words :
         {"Gap/A0 0 (0 mm)", "up ", "down ",
          "60 weights = 175.3 N at Omega/omega 1.4 (6.3 Hz), where z = 1/1 ends with a jump: no resonance",
          "40 weights = 116.9 N at Omega/omega 1 (4.5 Hz), where z = 1/1 begins",
          "70 weights = 204.6 N at Omega/omega 1.8 (8.1 Hz), chaotic",
          "1.5 (6.75 Hz) from 1/1 (60 weights) to no impact (0 weights)\n",
          "1.9 (8.55 Hz) from chaotic (70 weights) to 1/2 (20 weights)",
          "1.1 (4.95 Hz) from no impact (0 weights) to 1/1 (40 weights)", "hysteresis",
          "up 1/1, down no impact", "1/1 50.0 %, no impact 16.7 %"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_EQ(text.find("impact resonance"), std::string::npos) << text;
}

// Only a largest force at an end of the branch may go on growing beyond it.
TEST(SweepSummary, ALargestForceAtAnEndMayBeLargerBeyond) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.0, .to = 2.0, .points = 6};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::up};
    for (std::size_t place = 0; place < 6; ++place) {
        std::vector<StoredCell> cells(6, orbit(1, 2, 20));
        cells[place] = chaos(70);
        const std::vector<BranchFindings> branches{find_in_branch({0, job::Direction::up}, cells)};
        const std::string text = sweep_summary(scene::Scene(job), branches);
        EXPECT_NE(text.find("70 weights"), std::string::npos) << text;
        EXPECT_EQ(text.find("it may be larger beyond") != std::string::npos, place == 0 || place == 5)
            << place << text;
    }
}

TEST(SweepSummary, IsInHertzMillimetresAndNewtonsWhereTheJobIs) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 4.5, .to = 9.0, .points = 6, .over = "frequency_hz"};
    job.sweep = {.gap_ratio = {}, .gap_m = {0.89e-3}, .direction = job::Direction::both};
    const std::vector<BranchFindings> branches{rising(), falling()};
    const std::string text = sweep_summary(scene::Scene(job), branches);
    for (const char* words :
         {"\nGap 0.89 mm (gap/A0 1)\n",
          "175.3 N = 60 weights at frequency 6.3 Hz, where z = 1/1 ends with a jump: no resonance",
          "6.75 Hz from 1/1 (175 N) to no impact (0 N)\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_EQ(text.find("Omega"), std::string::npos) << text;
}

// Along an amplitude a gap is one ratio or one length, and told as that.
TEST(SweepSummary, TellsOfAGapWhatAnAxisLeavesTheSame) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1e-3, .to = 2e-3, .points = 6, .over = "cart.amplitude_m"};
    job.sweep = {.gap_ratio = {0.5}, .direction = job::Direction::both};
    const std::vector<BranchFindings> branches{rising(), falling()};
    const std::string of_ratio = sweep_summary(scene::Scene(job), branches);
    EXPECT_NE(of_ratio.find("\nGap/A0 0.5\n"), std::string::npos) << of_ratio;
    job.sweep = {.gap_ratio = {}, .gap_m = {1.5e-3}, .direction = job::Direction::both};
    const std::string of_length = sweep_summary(scene::Scene(job), branches);
    EXPECT_NE(of_length.find("\nGap 1.5 mm\n"), std::string::npos) << of_length;
}

TEST(SweepSummary, TellsEachHysteresisAndTheMotionsAtItsEnds) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.0, .to = 2.0, .points = 6};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::both};
    const auto told = [&](std::vector<StoredCell> up, std::vector<StoredCell> down) {
        const std::vector<BranchFindings> branches{find_in_branch({0, job::Direction::up}, std::move(up)),
                                                   find_in_branch({0, job::Direction::down}, std::move(down))};
        return sweep_summary(scene::Scene(job), branches);
    };
    const StoredCell one = orbit(1, 1, 40);
    const StoredCell strong = orbit(1, 1, 60);
    const std::string text =
        told({one, one, one, one, one, one}, {orbit(2, 1, 50), orbit(3, 2, 50), one, one, strong, strong});
    EXPECT_NE(told({one, one, one, one, one, one}, {one, one, one, orbit(2, 1, 50), one, one})
                  .find(" 1.6 (7.2 Hz) alone: up 1/1, down 2/1\n"),
              std::string::npos);
    for (const char* words : {"1 (4.5 Hz) to 1.2 (5.4 Hz), width 0.2 (0.9 Hz): up 1/1, down 2/1 to 3/2\n",
                              "1.8 (8.1 Hz) to 2 (9 Hz), width 0.2 (0.9 Hz): 1/1, at 1.8 (8.1 Hz) up 40 "
                              "weights, down 60 weights\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
}

// Those next to a point without a known speed have no size, and are told only if there is room for them.
TEST(SweepSummary, ListsTheLargestJumpsOnARigidStopByTheirImpactSpeeds) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.contact = job::Restitution{0.5};
    job.columns = {.from = 1.0, .to = 1.8, .points = 9};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::up};
    const auto told = [&](const std::vector<double>& speeds) {
        std::vector<StoredCell> cells;
        for (const double speed : speeds) cells.push_back(rigid_orbit(speed, !cells.empty()));
        const std::vector<BranchFindings> branches{find_in_branch({0, job::Direction::up}, cells)};
        return sweep_summary(scene::Scene(job), branches);
    };
    const double unknown = std::nan("");
    // the jumps: 5, unknown, unknown, 1, 2, 3, 4, 6
    const std::string text = told({7, 2, unknown, 1, 2, 4, 1, 5, 11});
    for (const char* words :
         {"1.05 (4.725 Hz) from 1/1 (7 m/s) to 1/1 (2 m/s)\n", "from 1/1 (2 m/s) to 1/1 (4 m/s)\n",
          "from 1/1 (4 m/s) to 1/1 (1 m/s)\n", "from 1/1 (1 m/s) to 1/1 (5 m/s)\n",
          "from 1/1 (5 m/s) to 1/1 (11 m/s)\n", "and 3 smaller ones\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_NE(told({7, 2, unknown}).find("from 1/1 (2 m/s) to 1/1\n"), std::string::npos);
}

// Each gap's starts follow its last branch.
TEST(SweepSummary, TellsOfTheStartsOfEachGap) {
    for (const auto direction : {job::Direction::up, job::Direction::both}) {
        const bool both = direction == job::Direction::both;
        job::Job job = testing::job_170mm(0);
        job.kind = job::Kind::sweep;
        job.columns = {.from = 1.0, .to = 2.0, .points = 6};
        job.sweep = {.gap_ratio = {0.0, 0.5, 1.0}, .direction = direction};
        std::vector<BranchFindings> branches;
        for (int gap = 0; gap < 3; ++gap) {
            branches.push_back(rising());
            branches.back().branch.gap = 0.5 * gap;
            if (both) branches.push_back(falling());
            branches.back().branch.gap = 0.5 * gap;
        }
        std::vector<GapAttractors> beside(3);
        for (int gap = 0; gap < 3; ++gap)
            beside[static_cast<std::size_t>(gap)] = {.points = 6, .several = 2 + gap, .most = 2};
        const std::string text = sweep_summary(scene::Scene(job), branches, beside);
        std::size_t at = 0;
        for (const char* words : {"Gap/A0 0 ", "2 of 6 points have several", "Gap/A0 0.5 ",
                                  "3 of 6 points have several", "Gap/A0 1 ", "4 of 6 points have several"}) {
            at = text.find(words, at);
            ASSERT_NE(at, std::string::npos) << words << "\n" << text;
        }
        EXPECT_EQ(text.find("points have several", at + 20), std::string::npos) << text;
    }
}

TEST(SweepSummary, TwoMotionsWithOneLabelHaveTheirForces) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.0, .to = 2.0, .points = 3};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::both};
    const auto text = [&](double up, double down) {
        const std::vector<StoredCell> low(3, orbit(1, 1, down));
        const std::vector<StoredCell> high(3, orbit(1, 1, up));
        const std::vector<BranchFindings> branches{find_in_branch({0, job::Direction::up}, high),
                                                   find_in_branch({0, job::Direction::down}, low)};
        return sweep_summary(scene::Scene(job), branches);
    };
    EXPECT_NE(text(40, 30).find("1/1, at 1.5 (6.75 Hz) up 40 weights, down 30 weights"), std::string::npos);
    EXPECT_NE(text(1004, 990.2).find("up 1004 weights, down 990.2 weights"), std::string::npos);
}

TEST(SweepSummary, CallsAMaximumInsideTheBandAResonance) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.0, .to = 2.0002, .points = 3};
    job.sweep = {.gap_ratio = {0.0}, .direction = job::Direction::up};
    const auto text = [&](std::vector<StoredCell> cells) {
        const std::vector<BranchFindings> branches{find_in_branch({0, job::Direction::up}, std::move(cells))};
        return sweep_summary(scene::Scene(job), branches);
    };
    const std::string inside = text({orbit(1, 1, 40), orbit(1, 1, 60), orbit(1, 1, 50)});
    EXPECT_NE(
        inside.find(
            "impact resonance  60 weights = 175.3 N at Omega/omega 1.5001 (6.75045 Hz), the largest of z"),
        std::string::npos)
        << inside;
    const std::string rising = text({orbit(1, 1, 40), orbit(1, 1, 50), orbit(1, 1, 60)});
    EXPECT_NE(rising.find("largest 1/1 force 60 weights = 175.3 N at Omega/omega 2.0002 (9.0009 Hz), at the "
                          "end of the sweep"),
              std::string::npos)
        << rising;
}

}  // namespace
}  // namespace peterka
