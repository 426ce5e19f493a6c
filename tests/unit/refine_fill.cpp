// Filling a cell: only within one regime and one z, and only with smooth numbers.
#include "refine/fill.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "map_examples.hpp"
#include "refine/lattice.hpp"

namespace peterka::refine {
namespace {

using attractors::CellAttractor;
using regime::CellResult;
using regime::Regime;
using regime::Status;

// The cells on every fourth row and column around (row, column) of a 33 by 33 grid.
class Around {
  public:
    Around(const std::function<CellResult(double, double)>& cell_at, std::int64_t row, std::int64_t column,
           std::int64_t stride = 2)
        : rows_(stencil_of({33, 4}, row)), columns_(stencil_of({33, 4}, column)), stride_(stride) {
        for (std::size_t i = 0; i < rows_.size; ++i) {
            for (std::size_t j = 0; j < columns_.size; ++j) {
                cells_.push_back({cell_at(static_cast<double>(rows_.positions[i]),
                                          static_cast<double>(columns_.positions[j])),
                                  {}});
            }
        }
    }

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    CellResult& operator[](std::size_t i) { return cells_[i].cell; }  // row by row
    void set_attractors(std::size_t i, const std::vector<CellAttractor>& attractors) {
        cells_[i].attractors = attractors;
        cells_[i].cell.attractors = static_cast<std::int32_t>(attractors.size());
    }
    void set_outcomes(std::size_t i, const std::vector<attractors::CellOutcome>& outcomes) {
        cells_[i].outcomes = outcomes;
        cells_[i].cell.outcomes = static_cast<std::int32_t>(outcomes.size());
    }
    [[nodiscard]] std::optional<CellResult> filled(const job::Job& job = {}) const {
        const auto solved = filled_with_attractors(job);
        return solved ? std::optional(solved->cell) : std::nullopt;
    }
    [[nodiscard]] std::optional<attractors::SolvedCell> filled_with_attractors(const job::Job& job) const {
        Surroundings around(rows_, columns_, stride_);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            around.set(i / columns_.size, i % columns_.size, cells_[i]);
        }
        return refine::filled(around, interpolated_quantities(job), {job.starts.count, job.uncertainty.rigs});
    }

  private:
    Stencil rows_;
    Stencil columns_;
    std::int64_t stride_;
    std::vector<attractors::SolvedCell> cells_;
};

CellResult periodic(double force) {
    return {.regime = Regime::periodic,
            .engine = regime::Engine::split,
            .impacts = 2,
            .period = 4,
            .cycles = 77,
            .peak_force = force,
            .impact_rate = 0.5,
            .sensitivity = 3};
}

CellResult smooth(double row, double column) {
    return periodic(40 + 0.3 * row + 0.2 * column + 1e-4 * row * row * column);
}

CellResult chaotic(double, double) {
    return {.regime = Regime::chaotic, .cycles = 1000, .peak_force = 9, .impact_rate = 0.7};
}

TEST(RefineFill, InsideOneRegimeAndOneZ) {
    const auto cell = Around(smooth, 13, 22).filled();
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->regime, Regime::periodic);
    EXPECT_EQ(cell->impacts, 2);
    EXPECT_EQ(cell->period, 4);
    EXPECT_EQ(cell->engine, regime::Engine::split);
    EXPECT_NEAR(cell->peak_force, smooth(13, 22).peak_force, 1e-12);
    EXPECT_EQ(cell->impact_rate, 0.5);
    EXPECT_FALSE(cell->computed);
}

TEST(RefineFill, WhatBelongsToARunIsUnknownWithoutOne) {
    const auto cell = Around(smooth, 13, 22).filled();
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->cycles, 0);
    EXPECT_TRUE(std::isnan(cell->sensitivity));
}

TEST(RefineFill, AnyOtherCellAroundForbidsIt) {
    const std::vector<std::function<void(CellResult&)>> changes{
        [](CellResult& cell) { cell.regime = Regime::no_impact; },
        [](CellResult& cell) { cell.impacts = 3; },
        [](CellResult& cell) { cell.period = 2; },
        [](CellResult& cell) { cell.chatter = true; },
        [](CellResult& cell) { cell.peak_force += 3; },
        [](CellResult& cell) { cell.peak_force = regime::unknown; },
    };
    for (std::size_t which = 0; which < changes.size(); ++which) {
        for (std::size_t place = 0; place < 16; ++place) {
            Around around(smooth, 14, 22);
            changes[which](around[place]);
            EXPECT_FALSE(around.filled()) << which << " at " << place;
        }
    }
}

TEST(RefineFill, CellsWithoutAProofSayNothing) {
    for (const Regime regime : {Regime::unresolved, Regime::failed}) {
        Around around([&](double, double) { return CellResult{.regime = regime, .peak_force = 0}; }, 14, 22);
        EXPECT_FALSE(around.filled());
    }
}

TEST(RefineFill, ABendForbidsIt) {
    const auto bend = [](double row, double) { return periodic(10 + 0.2 * std::abs(row - 14)); };
    EXPECT_FALSE(Around(bend, 14, 22).filled());
    EXPECT_TRUE(Around(bend, 22, 22).filled());
}

TEST(RefineFill, AJumpForbidsItAlsoHalfWay) {
    const auto jump = [](double, double column) { return periodic(column < 22 ? 10 : 12); };
    EXPECT_FALSE(Around(jump, 14, 22).filled()) << "where linear and cubic interpolation give the same";
    EXPECT_FALSE(Around(jump, 14, 26).filled());
    EXPECT_TRUE(Around(jump, 14, 6).filled());
}

TEST(RefineFill, ARigidStopHasNoForceButItsOtherNumbersMustBeSmooth) {
    const auto rigid = [](double row, double) {
        CellResult cell = periodic(regime::unknown);
        cell.impact_speed = row < 14 ? 1 : 2;
        return cell;
    };
    job::Job asks_for_speed;
    asks_for_speed.output.fields = {job::OptionalField::impact_speed};
    EXPECT_FALSE(Around(rigid, 14, 22).filled(asks_for_speed));
    const auto cell = Around(rigid, 22, 22).filled(asks_for_speed);
    ASSERT_TRUE(cell);
    EXPECT_TRUE(std::isnan(cell->peak_force));
    EXPECT_EQ(cell->impact_speed, 2);
    EXPECT_TRUE(Around(rigid, 14, 22).filled()) << "nobody asked for its speed";
}

TEST(RefineFill, InsideChaosItIsChaoticWithoutNumbers) {
    const auto cell = Around(chaotic, 14, 22).filled();
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->regime, Regime::chaotic);
    EXPECT_EQ(cell->period, 0);
    EXPECT_EQ(cell->cycles, 0);
    EXPECT_TRUE(std::isnan(cell->peak_force));
    EXPECT_TRUE(std::isnan(cell->impact_rate));
    EXPECT_FALSE(cell->computed);
}

TEST(RefineFill, ChaosNextToItCounts) {
    for (const std::size_t place : {5U, 6U, 9U, 10U}) {
        Around around(chaotic, 14, 22, 1);
        around[place] = smooth(0, 0);
        EXPECT_FALSE(around.filled()) << place;
    }
}

TEST(RefineFill, InsideChaosFewerOthersAreAllowedTheCoarserTheLattice) {
    const std::vector<std::size_t> far{0, 3, 7, 13, 15};
    for (const auto& [stride, allowed] :
         std::vector<std::pair<std::int64_t, std::size_t>>{{1, 4}, {2, 2}, {4, 1}, {8, 0}}) {
        Around around(chaotic, 14, 22, stride);
        for (std::size_t i = 0; i < allowed; ++i) around[far[i]] = smooth(0, 0);
        EXPECT_TRUE(around.filled()) << stride;
        around[far[allowed]] = smooth(0, 0);
        EXPECT_FALSE(around.filled()) << stride;
    }
}

TEST(RefineFill, OnALineOfTheLatticeItsNeighboursOnBothSidesCount) {
    Around around(smooth, 12, 22);
    ASSERT_EQ(around.size(), 12U);
    EXPECT_TRUE(around.filled());
    around[0].impacts = 3;
    EXPECT_FALSE(around.filled());
}

// z = 2/4, the regime of `periodic`, with a share that increases along the rows, and no impact.
std::vector<CellAttractor> two_attractors(double row) {
    CellAttractor orbit{Regime::periodic, Status::verified, 2, 4, 40 + row, 0.4 + row / 320};
    orbit.kick = {0.5 + row, 1.5, 0.5 + row, 1};
    orbit.orbit_displacement = orbit.orbit_velocity = row;
    CellAttractor free{Regime::no_impact, Status::verified, 0, 1, 0, 1 - orbit.share};
    return orbit.share > free.share ? std::vector{orbit, free} : std::vector{free, orbit};
}

Around with_attractors() {
    Around around(smooth, 14, 22);
    const Stencil rows = stencil_of({33, 4}, 14);
    for (std::size_t i = 0; i < around.size(); ++i) {
        around.set_attractors(
            i, two_attractors(static_cast<double>(rows.positions[i / (around.size() / rows.size)])));
    }
    return around;
}

job::Job with_starts(std::int64_t count) {
    job::Job job;
    job.starts.count = count;
    return job;
}

TEST(RefineFill, AttractorsTooAreInterpolatedLabelByLabel) {
    const auto solved = with_attractors().filled_with_attractors(with_starts(64));
    ASSERT_TRUE(solved);
    ASSERT_EQ(solved->attractors.size(), 2U);
    EXPECT_EQ(solved->cell.attractors, 2);
    EXPECT_EQ(solved->cell.start_attractor, 1);
    EXPECT_EQ(solved->attractors[0].regime, Regime::no_impact);
    EXPECT_NEAR(solved->attractors[0].share, 0.6 - 14.0 / 320, 1e-12);
    EXPECT_EQ(solved->attractors[1].period, 4);
    EXPECT_NEAR(solved->attractors[1].share, 0.4 + 14.0 / 320, 1e-12);
    EXPECT_NEAR(solved->attractors[1].peak_force, 54, 1e-12);
    // trials and verifications of the surrounding cells do not apply to this one
    EXPECT_EQ(static_cast<int>(solved->attractors[1].status), regime::regime_not_computed);
    EXPECT_TRUE(std::isnan(solved->attractors[1].kick.size));
    EXPECT_TRUE(std::isnan(solved->attractors[1].kick.tried));
    EXPECT_TRUE(std::isnan(solved->attractors[1].orbit_displacement));
}

TEST(RefineFill, NotWhereAttractorsDifferAnywhereAround) {
    const std::vector<std::function<void(std::vector<CellAttractor>&)>> changes{
        [](auto& attractors) { attractors.pop_back(); },
        [](auto& attractors) {
            attractors.push_back({Regime::chaotic, Status::verified, 0, 0, 1, 0.1});
        },
        [](auto& attractors) { attractors[0].impacts = 7; },
        [](auto& attractors) { attractors[1] = attractors[0]; },
        [](auto& attractors) { attractors[0].share += 0.2; },
    };
    for (std::size_t which = 0; which < changes.size(); ++which) {
        for (std::size_t place = 0; place < 16; ++place) {
            Around around = with_attractors();
            std::vector<CellAttractor> changed = two_attractors(12);
            changes[which](changed);
            around.set_attractors(place, changed);
            EXPECT_FALSE(around.filled_with_attractors(with_starts(64))) << which << " at " << place;
        }
    }
}

// Two outcomes, whose probabilities and quantiles change along the rows.
Around with_outcomes(CellResult (*value)(double, double)) {
    Around around(value, 13, 22);
    for (std::size_t i = 0; i < around.size(); ++i) {
        const double share = 0.3 + 0.001 * static_cast<double>(i / 4);
        around.set_outcomes(i, {{Regime::periodic, 2, 4, 1 - share}, {Regime::no_impact, 0, 1, share}});
        around[i].drawn_q05 = around[i].drawn_q50 = around[i].drawn_q95 =
            40 + 0.01 * static_cast<double>(i / 4);
    }
    return around;
}

job::Job with_rigs() {
    job::Job job;
    job.uncertainty.rigs = 64;
    return job;
}

TEST(RefineFill, OutcomesOfDrawnRigs) {
    for (auto* value : {smooth, chaotic}) {
        const auto solved = with_outcomes(value).filled_with_attractors(with_rigs());
        ASSERT_TRUE(solved);
        ASSERT_EQ(solved->outcomes.size(), 2U);
        EXPECT_EQ(solved->cell.outcomes, 2);
        EXPECT_EQ(solved->outcomes[0].impacts, 2);
        EXPECT_EQ(solved->outcomes[1].regime, Regime::no_impact);
        EXPECT_NEAR(solved->outcomes[0].probability + solved->outcomes[1].probability, 1, 1e-12);
        EXPECT_NEAR(solved->cell.drawn_q95, 40, 0.05);
    }
    EXPECT_TRUE(Around(smooth, 13, 22).filled_with_attractors({})->outcomes.empty());
}

TEST(RefineFill, OtherOutcomesOrRoughQuantilesForbidIt) {
    const std::vector<std::function<void(Around&, std::size_t)>> changes{
        [](Around& around, std::size_t i) {
            around.set_outcomes(i, {{Regime::periodic, 2, 4, 1.0}});
        },
        [](Around& around, std::size_t i) {
            around.set_outcomes(i, {{Regime::periodic, 3, 4, 0.7}, {Regime::no_impact, 0, 1, 0.3}});
        },
        [](Around& around, std::size_t i) {
            around.set_outcomes(i, {{Regime::periodic, 2, 4, 0.5}, {Regime::no_impact, 0, 1, 0.5}});
        },
        [](Around& around, std::size_t i) { around[i].outcomes = 9; },
        [](Around& around, std::size_t i) { around[i].drawn_q95 += 3; },
    };
    for (auto* value : {smooth, chaotic}) {
        for (std::size_t which = 0; which < changes.size(); ++which) {
            for (std::size_t place = 0; place < 16; ++place) {
                Around around = with_outcomes(value);
                changes[which](around, place);
                EXPECT_FALSE(around.filled_with_attractors(with_rigs())) << which << " at " << place;
            }
        }
    }
}

}  // namespace
}  // namespace peterka::refine
