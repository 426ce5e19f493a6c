// The cells of drawn rigs: the units of their place, and the start in front of a drawn stop.
#include "scene/uncertain_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "rig.hpp"

namespace peterka::scene {
namespace {

job::Job map_at(double gap_ratio, double start) {
    job::Job job = testing::job_170mm(0);
    job.columns = {.from = 2, .to = 3, .points = 2};
    job.rows = {.from = gap_ratio, .to = gap_ratio, .points = 1};
    job.start.displacement_ratio = start;
    job.uncertainty.rigs = 64;
    return job;
}

TEST(UncertainCells, AreAtTheSamePlaceInSiUnits) {
    job::Job job = map_at(1, -1);
    job.uncertainty.numbers["hammer.natural_frequency_hz"].relative = 0.05;
    job.uncertainty.numbers["cart.amplitude_m"].relative = 0.05;
    const UncertainCells cells(job);
    EXPECT_TRUE(cells.rigs_differ());
    for (std::size_t n = 0; n < cells.count(); ++n) {
        const Cell cell = cells.cell(job::numbers_at(job, 0, 1), n);
        const double hertz =
            cell.oscillator.frequency * cell.scales.frequency_rad_per_s / (2 * std::numbers::pi);
        EXPECT_NEAR(hertz, 3 * 4.5, 1e-12);
        EXPECT_NEAR(cell.oscillator.gap * cell.scales.length_m, 0.89e-3, 1e-15);
        EXPECT_NEAR((cell.start[0] + cell.oscillator.gap) * cell.scales.length_m, -0.89e-3, 1e-15);
        EXPECT_NEAR(cell.start[1], -cell.oscillator.frequency, 1e-12);  // at rest in the room
    }
}

TEST(UncertainCells, AStopThatIsCloserPushesTheHammerAlong) {
    for (const double depth : {0.0, 0.25}) {
        job::Job job = map_at(0.5, 0.5 + depth);
        job.uncertainty.numbers["operating_point.gap_m"].standard_deviation = 1e-4;
        const UncertainCells cells(job);
        EXPECT_FALSE(cells.rigs_differ());
        int pushed = 0;
        for (std::size_t n = 0; n < cells.count(); ++n) {
            const Cell cell = cells.cell(job::numbers_at(job, 0, 0), n);
            EXPECT_LE(cell.start[0], depth + 1e-12);
            pushed += std::abs(cell.start[0] - depth) < 1e-12 ? 1 : 0;
        }
        EXPECT_EQ(pushed, 32);  // where the gap is smaller than the cell's own
    }
}

// A rig that an axis varies is drawn around the cell's own.
TEST(UncertainCells, AreAroundTheCellsOwnRig) {
    job::Job job = map_at(1, 0);
    job.columns = {.from = 0.2, .to = 0.4, .points = 2, .over = "hammer.mass_kg"};
    job.operating_point.frequency_ratio = 2;
    job.uncertainty.numbers["hammer.mass_kg"].relative = 0.01;
    const UncertainCells cells(job);
    for (const auto& [column, mass] : {std::pair(0, 0.2), std::pair(1, 0.4)}) {
        double sum = 0;
        for (std::size_t n = 0; n < cells.count(); ++n)
            sum += cells.cell(job::numbers_at(job, 0, column), n).scales.weight_n / standard_gravity;
        EXPECT_NEAR(sum / 64, mass, 1e-4 * mass);
    }
}

}  // namespace
}  // namespace peterka::scene
