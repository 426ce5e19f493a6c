// The attractors kept at a sweep's point after its branches have passed.
#include "attractors/along_branch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "attractors/tally.hpp"
#include "rig.hpp"

namespace peterka::attractors {
namespace {

using cell::Regime;

cell::CellResult orbit(double displacement) {
    cell::CellResult result;
    result.regime = Regime::periodic;
    result.impacts = result.period = 1;
    result.peak_force = displacement;
    result.orbit_displacement = displacement;
    result.orbit_velocity = 0;
    return result;
}

cell::CellResult settled_as(Regime regime) {
    cell::CellResult result;
    result.regime = regime;
    return result;
}

regime::BranchPoint on(const cell::CellResult& result) {
    return {result, regime::SteadyMotion(4), 1};
}

// Three orbits with shares, the largest first, identified by their displacements.
PointAttractors point() {
    PointAttractors found{.count = 3, .gap = 1};
    for (const double displacement : {1.0, 2.0, 3.0}) {
        found.kept.push_back(without_share(orbit(displacement)));
        found.kept.back().share = 0.6 / displacement;
        found.firsts.push_back({orbit(displacement), 0});
        found.motions.emplace_back(4);
    }
    return found;
}

std::vector<double> forces(const PointAttractors& point) {
    std::vector<double> found;
    for (const CellAttractor& each : point.kept) found.push_back(each.peak_force);
    return found;
}

TEST(AlongBranch, WhatABranchIsOnIsOneOfTheAttractors) {
    PointAttractors here = point();
    const auto up = on(orbit(2));
    const auto down = on(orbit(5));
    const auto chaos = on(settled_as(Regime::chaotic));
    keep_with(here, std::array{&up, &down, &chaos}, 8);
    ASSERT_EQ(here.kept.size(), 5U);
    EXPECT_EQ(here.firsts.size(), 5U);
    EXPECT_EQ(here.motions.size(), 5U);
    EXPECT_EQ(slot_of(here, up.cell), 1);
    EXPECT_EQ(slot_of(here, down.cell), 3);
    EXPECT_EQ(slot_of(here, chaos.cell), 4);
    EXPECT_EQ(here.kept[3].share, 0);
    EXPECT_EQ(here.count, 3);
}

TEST(AlongBranch, NoMotionIsKnownOfABranchThatFailed) {
    PointAttractors here = point();
    const auto failed = on(settled_as(Regime::failed));
    const auto open = on(settled_as(Regime::unresolved));
    keep_with(here, std::array{&failed, &open}, 8);
    EXPECT_EQ(here.kept.size(), 3U);
}

TEST(AlongBranch, TheSmallestSharesGiveWayButNotThoseOfBranches) {
    PointAttractors here = point();
    const auto up = on(orbit(3));
    const auto down = on(orbit(5));
    keep_with(here, std::array{&up, &down}, 3);
    EXPECT_EQ(forces(here), (std::vector<double>{1, 3, 5}));
}

// Also while starts are solved, before any of their motions is followed again.
TEST(AlongBranch, LooksWhileItSolvesARow) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = 1.5, .to = 2, .points = 2};
    job.sweep.gap_ratio = {0.5};
    job.uncertainty.rigs = 2;
    job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.03;
    const scene::Scene scene(job);
    struct Asked {};
    EXPECT_THROW(static_cast<void>(find_outcomes_along_branch(scene, 0, [] { throw Asked{}; })), Asked);
    int looks = 0;
    EXPECT_EQ(find_outcomes_along_branch(scene, 0, [&] { ++looks; }).size(), 2U);
    EXPECT_GT(looks, 0);
}

}  // namespace
}  // namespace peterka::attractors
