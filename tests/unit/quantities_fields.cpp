// The table of fields: what a job stores, and that cells survive the way through the bytes of a tile.
#include "quantities/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "map_examples.hpp"
#include "map_file/tile_bytes.hpp"

namespace peterka::quantities {
namespace {

using job::OptionalField;

std::vector<std::string> names(const std::vector<Field>& fields) {
    std::vector<std::string> all;
    for (const Field& field : fields) all.emplace_back(field.variable.name);
    return all;
}

const std::vector<std::string> always{"regime",           "status",      "engine", "impacts",        "period",
                                      "peak_force_ratio", "impact_rate", "cycles", "observed_cycles"};

// A rigid stop has a field of its own, and a refined map.
job::Job with_every_field() {
    job::Job job = map_file::examples::small_map(4, 4);
    job.contact = job::Restitution{0.6};
    job.refine.levels = 1;
    for (const auto& field : job::Names<OptionalField>::all) job.output.fields.push_back(field.value);
    return job;
}

TEST(OutputFields, MapStoresWhatItMustAndNoMore) {
    EXPECT_EQ(names(stored_fields(map_file::examples::small_map(4, 4))), always);
}

TEST(OutputFields, MapStoresWhatIsAskedFor) {
    job::Job job = map_file::examples::small_map(4, 4);
    job.output.fields = {OptionalField::multiplier, OptionalField::sensitivity};
    std::vector<std::string> expected = always;
    expected.insert(expected.end(), {"multiplier", "sensitivity"});
    EXPECT_EQ(names(stored_fields(job)), expected);
}

TEST(OutputFields, RefinedMapTellsWhatIsComputed) {
    job::Job job = map_file::examples::small_map(4, 4);
    job.refine.levels = 1;
    std::vector<std::string> expected = always;
    expected.insert(expected.begin() + 2, "computed");
    EXPECT_EQ(names(stored_fields(job)), expected);
}

TEST(OutputFields, BasinAlwaysStoresTheOrbit) {
    std::vector<std::string> expected = always;
    expected.insert(expected.end(), {"orbit_displacement", "orbit_velocity"});
    EXPECT_EQ(names(stored_fields(map_file::examples::small_basin(4, 4))), expected);
}

TEST(OutputFields, EveryOptionalFieldHasARowAndEveryRowItsOwnName) {
    const job::Job job = with_every_field();
    const std::vector<std::string> all = names(stored_fields(job));
    // chatter, computed; two or three datasets for one field, none here for critical_kick, which attractors
    // have
    EXPECT_EQ(all.size(), always.size() + 2 + job.output.fields.size() + 1 + 2 - 1);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
}

// Every member differs from every other, so that two fields that store the same member are found out.
regime::CellResult distinct_cell() {
    return {.regime = regime::Regime::chaotic,
            .status = regime::Status::budget,
            .engine = regime::Engine::arkode,
            .computed = false,
            .impacts = 11,
            .period = 12,
            .cycles = 13,
            .observed_cycles = 18,
            .peak_force = 1.5,
            .largest_displacement = 8.5,
            .chatter = true,
            .impact_rate = 2.5,
            .multiplier = 3.5,
            .lyapunov = 4.5,
            .sensitivity = 5.5,
            .orbit_displacement = 6.5,
            .orbit_velocity = 7.5,
            .impact_speed = 9.5,
            .impulse = 10.5,
            .contact_time = 11.5,
            .contact_power = 12.5,
            .max_displacement = 13.5,
            .peak_force_mean = 14.5,
            .peak_force_q95 = 15.5,
            .window_cycles = 16,
            .last_impact = 17};
}

TEST(OutputFields, EachFieldStoresItsOwnMember) {
    const job::Job job = with_every_field();
    std::vector<double> values;
    for (const Field& field : stored_fields(job)) values.push_back(field.member.load(distinct_cell()));
    EXPECT_EQ(values, (std::vector<double>{2,   1,   0,   3,   11,   12,   1.5,  1,    2.5,  13,   18, 3.5, 4.5,
                                           5.5, 6.5, 7.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5, 16, 17}));
}

TEST(OutputFields, CellsComeBackFromBytes) {
    const std::vector<Field> fields = stored_fields(map_file::examples::small_basin(4, 4));
    std::vector<StoredCell> cells{distinct_cell(), map_file::examples::made_up_cell(1, 2),
                                  map_file::examples::made_up_cell(2, 2)};
    const std::vector<std::byte> bytes = map_file::encode(fields, cells);
    EXPECT_EQ(bytes.size(), 3 * (3 * 1 + 4 * 4 + 4 * 8));
    const std::vector<StoredCell> back = map_file::decode(fields, bytes, 3);
    ASSERT_EQ(back.size(), 3);
    EXPECT_EQ(map_file::encode(fields, back), bytes);
    EXPECT_EQ(back[0].regime, regime::Regime::chaotic);
    EXPECT_EQ(back[0].impacts, 11);
    EXPECT_EQ(back[0].orbit_velocity, 7.5);
}

constexpr scene::Scales four_weights{.force_n = 20, .weight_n = 5};

TEST(OutputFields, ForceIsStoredOverTheHammersWeight) {
    EXPECT_EQ(in_file_units(distinct_cell(), four_weights).peak_force, 6.0);
    EXPECT_EQ(in_file_units(distinct_cell(), four_weights).peak_force_mean, 58.0);
    EXPECT_EQ(in_file_units(distinct_cell(), four_weights).peak_force_q95, 62.0);
    EXPECT_EQ(in_file_units(distinct_cell(), four_weights).impact_rate, 2.5);
}

TEST(OutputFields, ImpactsAreStoredInSiUnits) {
    const scene::Scales scales{.length_m = 2, .frequency_rad_per_s = 4, .force_n = 8};
    const StoredCell stored = in_file_units(distinct_cell(), scales);
    EXPECT_EQ(stored.impact_speed, 9.5 * 8);     // A0 omega
    EXPECT_EQ(stored.impulse, 10.5 * 2);         // k A0/omega
    EXPECT_EQ(stored.contact_time, 11.5 / 4);    // 1/omega
    EXPECT_EQ(stored.contact_power, 12.5 * 64);  // k A0^2 omega
    EXPECT_EQ(stored.max_displacement, 27);      // A0
}

TEST(OutputFields, EveryNanIsTheSame) {
    regime::CellResult positive = map_file::examples::made_up_cell(0, 0);
    positive.peak_force = std::numeric_limits<double>::quiet_NaN();
    regime::CellResult negative = positive;
    negative.peak_force = -positive.peak_force;
    ASSERT_NE(std::memcmp(&positive.peak_force, &negative.peak_force, sizeof(double)), 0);
    const std::vector<Field> fields = stored_fields(map_file::examples::small_map(4, 4));
    const std::vector<StoredCell> first{in_file_units(positive, {})};
    const std::vector<StoredCell> second{in_file_units(negative, {})};
    EXPECT_EQ(map_file::encode(fields, first), map_file::encode(fields, second));
}

TEST(OutputTileBytes, ChecksumIsXxh3) {
    EXPECT_EQ(map_file::checksum({}), 0x2D06800538D394C2U);
}

TEST(OutputTileBytes, ChecksumFindsEveryFlippedByte) {
    const std::vector<Field> fields = stored_fields(map_file::examples::small_map(4, 4));
    const std::vector<StoredCell> cells(16, map_file::examples::made_up_cell(3, 1));
    std::vector<std::byte> bytes = map_file::encode(fields, cells);
    const std::uint64_t whole = map_file::checksum(bytes);
    for (std::byte& byte : bytes) {
        byte ^= std::byte{1};
        EXPECT_NE(map_file::checksum(bytes), whole);
        byte ^= std::byte{1};
    }
    EXPECT_EQ(map_file::checksum(bytes), whole);
}

}  // namespace
}  // namespace peterka::quantities
