// Which cells share an attractor, and the order of the table.
#include "findings/attractors.hpp"
#include "regime/same_attractor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace peterka::findings {
namespace {

using regime::Regime;
using regime::same_attractor;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

quantities::StoredCell orbit(std::int32_t impacts, std::int32_t period, double displacement, double velocity,
                             double force = 1) {
    quantities::StoredCell cell;
    cell.regime = Regime::periodic;
    cell.impacts = impacts;
    cell.period = period;
    cell.peak_force = force;
    cell.orbit_displacement = displacement;
    cell.orbit_velocity = velocity;
    return cell;
}

quantities::StoredCell of_regime(Regime regime) {
    quantities::StoredCell cell;
    cell.regime = regime;
    return cell;
}

TEST(OutputAttractors, OnlyProvedRegimesHaveOne) {
    EXPECT_TRUE(has_attractor(of_regime(Regime::no_impact)));
    EXPECT_TRUE(has_attractor(of_regime(Regime::chaotic)));
    EXPECT_TRUE(has_attractor(of_regime(Regime::sustained_contact)));
    EXPECT_TRUE(has_attractor(orbit(1, 1, 0, 0)));
    EXPECT_FALSE(has_attractor(of_regime(Regime::unresolved)));
    EXPECT_FALSE(has_attractor(of_regime(Regime::failed)));
    EXPECT_FALSE(has_attractor(of_regime(static_cast<Regime>(regime::regime_not_computed))));
    EXPECT_FALSE(has_attractor(orbit(1, 1, no_number, 0)));
    EXPECT_FALSE(has_attractor(orbit(1, 1, 0, no_number)));
}

TEST(OutputAttractors, OrbitsOfRigidStopsHaveOneWithoutAForce) {
    EXPECT_TRUE(has_attractor(orbit(1, 1, 0, 0, no_number)));
    const std::vector<Attractor> sorted{{orbit(1, 1, 0.2, 1, no_number)},
                                        {orbit(1, 1, 0.3, -1, no_number)},
                                        {orbit(1, 1, 0.3, 1, no_number)},
                                        {orbit(2, 1, 0, 0, no_number)}};
    std::vector<Attractor> table{sorted[2], sorted[3], sorted[1], sorted[0]};
    sort_canonically(table);
    for (std::size_t i = 0; i < table.size(); ++i)
        EXPECT_EQ(row_of(sorted, table[i].cell), static_cast<std::int32_t>(i));
}

TEST(OutputAttractors, OrbitsAreToldApartByZAndByTheirPoint) {
    EXPECT_TRUE(same_attractor(orbit(1, 1, 0.5, 2), orbit(1, 1, 0.5 + 1e-7, 2 - 1e-7)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0.5, 2), orbit(1, 1, 0.5 + 1e-5, 2)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0.5, 2), orbit(1, 1, 0.5, 2 + 1e-5)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0.5, 2), orbit(2, 1, 0.5, 2)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0.5, 2), orbit(1, 2, 0.5, 2)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0.5, 2), of_regime(Regime::no_impact)));
}

TEST(OutputAttractors, ToleranceIsRelativeForLargeValues) {
    EXPECT_TRUE(same_attractor(orbit(1, 1, 0, 1e4), orbit(1, 1, 0, 1e4 + 5e-3)));
    EXPECT_FALSE(same_attractor(orbit(1, 1, 0, 1e4), orbit(1, 1, 0, 1e4 + 5e-2)));
}

TEST(OutputAttractors, OtherRegimesAreOneEach) {
    EXPECT_TRUE(same_attractor(of_regime(Regime::chaotic), of_regime(Regime::chaotic)));
    EXPECT_FALSE(same_attractor(of_regime(Regime::chaotic), of_regime(Regime::no_impact)));
}

TEST(OutputAttractors, CanonicalOrderDoesNotDependOnTheOrderFound) {
    const std::vector<Attractor> sorted{
        {of_regime(Regime::no_impact)}, {orbit(1, 1, 0.3, 0.1, 5)},   {orbit(1, 1, 0.2, 0.1, 6)},
        {orbit(2, 1, 0, 0, 1)},         {orbit(1, 2, -0.5, 0, 1)},    {orbit(1, 2, 0.5, -1, 1)},
        {orbit(1, 2, 0.5, 1, 1)},       {of_regime(Regime::chaotic)}, {of_regime(Regime::sustained_contact)},
    };
    std::mt19937 random(1);
    for (int repeat = 0; repeat < 20; ++repeat) {
        std::vector<Attractor> table = sorted;
        std::ranges::shuffle(table, random);
        sort_canonically(table);
        for (std::size_t i = 0; i < table.size(); ++i) {
            EXPECT_EQ(row_of(sorted, table[i].cell), static_cast<std::int32_t>(i));
        }
    }
}

TEST(OutputAttractors, RowOfACell) {
    const std::vector<Attractor> table{{of_regime(Regime::no_impact)}, {orbit(1, 1, 0.5, 0.5)}};
    EXPECT_EQ(row_of(table, of_regime(Regime::no_impact)), 0);
    EXPECT_EQ(row_of(table, orbit(1, 1, 0.5, 0.5)), 1);
    EXPECT_EQ(row_of(table, orbit(1, 1, 0.25, 0.5)), no_attractor);
    EXPECT_EQ(row_of(table, of_regime(Regime::failed)), no_attractor);
}

}  // namespace
}  // namespace peterka::findings
