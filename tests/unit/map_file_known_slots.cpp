// Which attractor is dropped if a cell has more attractors than slots, and that this is recorded.
#include "map_file/known_slots.hpp"

#include <gtest/gtest.h>

namespace peterka::map_file {
namespace {

using quantities::StoredAttractor;
using quantities::StoredCell;

// Attractors are identified by their force.
StoredAttractor slot(double share, double force) {
    StoredAttractor attractor;
    attractor.regime = regime::Regime::periodic;
    attractor.share = share;
    attractor.peak_force = force;
    return attractor;
}

StoredCell cell(std::int32_t attractors, std::int32_t start_attractor) {
    StoredCell cell;
    cell.attractors = attractors;
    cell.start_attractor = start_attractor;
    return cell;
}

std::vector<double> forces(const Slots& slots) {
    std::vector<double> found;
    for (const StoredAttractor& each : slots) found.push_back(each.peak_force);
    return found;
}

TEST(KnownSlots, ComeBehindThoseWithAShare) {
    StoredCell here = cell(2, 1);
    Slots slots{slot(0.6, 1), slot(0.4, 2)};
    add_known(here, slots, std::vector{slot(0, 3)}, 4);
    EXPECT_EQ(forces(slots), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(here.start_attractor, 1);
    EXPECT_FALSE(lost_slots(here, slots, 4));
    EXPECT_EQ(forces(own_slots(here, slots)), (std::vector<double>{1, 2}));
}

TEST(KnownSlots, TakeThePlaceOfTheSmallestShares) {
    StoredCell here = cell(3, 0);
    Slots slots{slot(0.5, 1), slot(0.3, 2), slot(0.2, 3)};
    add_known(here, slots, std::vector{slot(0, 4)}, 3);
    EXPECT_EQ(forces(slots), (std::vector<double>{1, 2, 4}));
    EXPECT_TRUE(lost_slots(here, slots, 3));
}

// The end state of [start] is known, too.
TEST(KnownSlots, LeaveThatOfTheOwnStart) {
    StoredCell here = cell(3, 2);
    Slots slots{slot(0.5, 1), slot(0.3, 2), slot(0.2, 3)};
    add_known(here, slots, std::vector{slot(0, 4)}, 3);
    EXPECT_EQ(forces(slots), (std::vector<double>{1, 3, 4}));
    EXPECT_EQ(here.start_attractor, 1);
}

TEST(KnownSlots, LeaveTheOwnStartThatHasNoShare) {
    StoredCell here = cell(2, 2);
    Slots slots{slot(0.7, 1), slot(0.3, 2), slot(0, 3)};
    EXPECT_FALSE(lost_slots(here, slots, 3));
    add_known(here, slots, std::vector{slot(0, 4)}, 3);
    EXPECT_EQ(forces(slots), (std::vector<double>{1, 3, 4}));
    EXPECT_EQ(here.start_attractor, 1);
    EXPECT_EQ(forces(own_slots(here, slots)), (std::vector<double>{1, 3}));
    EXPECT_TRUE(lost_slots(here, slots, 3));
}

TEST(KnownSlots, LeaveTheLargestShare) {
    StoredCell here = cell(2, 0);
    Slots slots{slot(0.7, 1)};
    add_known(here, slots, std::vector{slot(0, 3), slot(0, 4)}, 1);
    EXPECT_EQ(forces(slots), (std::vector<double>{1}));
    EXPECT_FALSE(lost_slots(here, slots, 1));
}

// Such a motion could be one of those that starts found and that had no room: without a share it would be told
// as found by none.
TEST(KnownSlots, AreNoneWhereSomeWithAShareHadNoRoom) {
    StoredCell here = cell(3, 0);
    Slots slots{slot(0.5, 1), slot(0.3, 2)};
    add_known(here, slots, std::vector{slot(0, 4)}, 2);
    EXPECT_EQ(forces(slots), (std::vector<double>{1, 2}));
}

// More than were stored from the beginning.
TEST(KnownSlots, AreNotMissedWhereTheCellHadNoRoom) {
    const StoredCell here = cell(5, 0);
    EXPECT_FALSE(lost_slots(here, {slot(0.4, 1), slot(0.3, 2)}, 2));
    EXPECT_TRUE(lost_slots(here, {slot(0.4, 1), slot(0, 2)}, 2));
}

}  // namespace
}  // namespace peterka::map_file
