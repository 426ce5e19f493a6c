// Lattices and stencils: the last position is always included, and weights reproduce polynomials.
#include "refine/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace peterka::refine {
namespace {

std::vector<std::int64_t> positions(const Lattice& lattice) {
    std::vector<std::int64_t> all;
    for (std::int64_t line = 0; line < lattice.lines(); ++line) all.push_back(lattice.position(line));
    return all;
}

TEST(RefineLattice, LastPositionIsIncluded) {
    EXPECT_EQ(positions({9, 4}), (std::vector<std::int64_t>{0, 4, 8}));
    EXPECT_EQ(positions({10, 4}), (std::vector<std::int64_t>{0, 4, 8, 9}));
    EXPECT_EQ(positions({3, 8}), (std::vector<std::int64_t>{0, 2}));
    EXPECT_EQ(positions({3, 1}), (std::vector<std::int64_t>{0, 1, 2}));
}

TEST(RefineLattice, EachPositionHasItsLine) {
    const Lattice lattice(10, 4);
    EXPECT_TRUE(lattice.has(9));
    EXPECT_FALSE(lattice.has(7));
    EXPECT_EQ(lattice.line_before(3), 0);
    EXPECT_EQ(lattice.line_before(8), 2);
    EXPECT_EQ(lattice.line_before(9), 3);
}

TEST(RefineLattice, FinerLatticesHoldTheCoarserOnes) {
    for (const std::int64_t points : {2, 3, 17, 40, 129}) {
        for (std::int64_t stride = 1; stride <= 32; stride *= 2) {
            for (const std::int64_t position : positions({points, 2 * stride})) {
                EXPECT_TRUE(Lattice(points, stride).has(position)) << points << " " << stride;
            }
        }
    }
}

TEST(RefineStencil, LinesNextToAPositionAndOneMoreOnEitherSide) {
    const Lattice lattice(33, 4);
    const Stencil inside = stencil_of(lattice, 14);
    ASSERT_EQ(inside.size, 4U);
    EXPECT_EQ(inside.positions, (std::array<std::int64_t, 4>{8, 12, 16, 20}));
    EXPECT_EQ(inside.weights, (std::array<double, 4>{-0.0625, 0.5625, 0.5625, -0.0625}));
    EXPECT_EQ(inside.before, 1U);
    EXPECT_EQ(inside.after, 2U);

    const Stencil on_a_line = stencil_of(lattice, 12);
    ASSERT_EQ(on_a_line.size, 3U);
    EXPECT_EQ(on_a_line.positions, (std::array<std::int64_t, 4>{8, 12, 16, 0}));
    EXPECT_EQ(on_a_line.weights, (std::array<double, 4>{0, 1, 0, 0}));
    EXPECT_EQ(on_a_line.before, 1U);
    EXPECT_EQ(on_a_line.after, 1U);

    EXPECT_EQ(stencil_of(lattice, 2).positions, (std::array<std::int64_t, 4>{0, 4, 8, 12}));
    EXPECT_EQ(stencil_of(lattice, 31).positions, (std::array<std::int64_t, 4>{20, 24, 28, 32}));
    EXPECT_EQ(stencil_of(lattice, 0).size, 2U);
    EXPECT_EQ(stencil_of(lattice, 32).size, 2U);
}

TEST(RefineStencil, WeightsReproducePolynomialsAtUnevenLinesToo) {
    for (const std::int64_t points : {3, 6, 10, 15, 30}) {
        const Lattice lattice(points, 4);
        for (std::int64_t at = 0; at < points; ++at) {
            const Stencil stencil = stencil_of(lattice, at);
            const auto degree = static_cast<double>(std::min<std::int64_t>(lattice.lines() - 1, 3));
            double value = 0;
            for (std::size_t i = 0; i < stencil.size; ++i) {
                const auto x = static_cast<double>(stencil.positions[i]);
                value += stencil.weights[i] * std::pow(x, degree);
            }
            EXPECT_NEAR(value, std::pow(static_cast<double>(at), degree), 1e-9);
        }
    }
}

TEST(RefineStencil, ReachHoldsTheStencilsOfAllPositions) {
    const Lattice lattice(50, 4);
    for (std::int64_t first = 0; first < 50; ++first) {
        for (std::int64_t last = first; last < 50; ++last) {
            const Interval reach = reach_of(lattice, {first, last});
            for (std::int64_t at = first; at <= last; ++at) {
                const Stencil stencil = stencil_of(lattice, at);
                EXPECT_LE(reach.first, stencil.positions[0]);
                EXPECT_GE(reach.last, stencil.positions[stencil.size - 1]);
                EXPECT_LE(stencil.positions[stencil.before], at);
                EXPECT_GE(stencil.positions[stencil.after], at);
            }
        }
    }
}

}  // namespace
}  // namespace peterka::refine
