// The sequence of starts: its region, its uniformity, and the effect of the stop.
#include "attractors/start_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace peterka::attractors {
namespace {

const job::Starts starts{.count = 1024, .displacement_ratio = {-4, 1}, .velocity_ratio = {-3, 5}};

scene::Cell cell(double gap) {
    scene::Cell cell;
    cell.oscillator.frequency = 2.5;
    cell.oscillator.gap = gap;
    return cell;
}

// Position in the unit square, from the absolute start.
scene::State<double> in_unit_square(const scene::State<double>& start, double gap) {
    return {(start[0] + gap + 4) / (std::min(1.0, gap) + 4), (start[1] + 2.5 + 3) / 8};
}

TEST(StartSequence, BeginsInTheMiddleAndStepsByPowersOfThePlasticNumber) {
    const double g = 1.32471795724474602596;
    for (std::int64_t n : {0, 1, 2, 63, 100'000}) {
        const auto point = in_unit_square(start_of(starts, cell(1), n), 1);
        const auto steps = static_cast<double>(n);
        EXPECT_NEAR(point[0], std::fmod(0.5 + steps / g, 1), 1e-10) << n;
        EXPECT_NEAR(point[1], std::fmod(0.5 + steps / (g * g), 1), 1e-10) << n;
    }
}

// The share of the points in any corner rectangle approximates its area (star discrepancy): for random points
// the largest deviation would be about 0.04.
TEST(StartSequence, HasALowDiscrepancy) {
    std::vector<scene::State<double>> points;
    for (std::int64_t n = 0; n < 1024; ++n) points.push_back(in_unit_square(start_of(starts, cell(3), n), 3));
    double worst = 0;
    for (double right = 0.05; right < 1; right += 0.05) {
        for (double top = 0.05; top < 1; top += 0.05) {
            const auto inside = std::ranges::count_if(
                points, [&](const auto& point) { return point[0] < right && point[1] < top; });
            worst = std::max(worst, std::abs(static_cast<double>(inside) / 1024 - right * top));
        }
    }
    EXPECT_LT(worst, 0.006);
}

TEST(StartSequence, IsSqueezedToEndAtTheStop) {
    double nearest = -10;
    for (std::int64_t n = 0; n < 1024; ++n) {
        const auto start = start_of(starts, cell(0.25), n);
        EXPECT_LE(start[0], 0);
        nearest = std::max(nearest, start[0]);
        const auto point = in_unit_square(start, 0.25);
        const auto free = in_unit_square(start_of(starts, cell(3), n), 3);
        EXPECT_NEAR(point[0], free[0], 1e-12);  // the same point of the square
        EXPECT_NEAR(point[1], free[1], 1e-12);
    }
    EXPECT_GT(nearest, -0.01);
}

}  // namespace
}  // namespace peterka::attractors
