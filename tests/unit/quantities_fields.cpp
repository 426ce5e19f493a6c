// The table of fields: which ones a job stores, and that cells survive conversion to a tile's bytes.
#include "quantities/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "job/names.hpp"
#include "map_examples.hpp"
#include "map_file/tile_bytes.hpp"

namespace peterka::quantities {
namespace {

using job::OptionalField;

template <class SomeField>
std::vector<std::string> names(const std::vector<SomeField>& fields) {
    std::vector<std::string> all;
    for (const SomeField& field : fields) all.emplace_back(field.variable.name);
    return all;
}

std::vector<std::string> names_of_cell_and_attractors(const job::Job& job) {
    std::vector<std::string> all = names(stored_fields(job));
    for (const std::string& name : names(stored_attractor_fields(job))) all.push_back(name);
    return all;
}

const std::vector<std::string> always{"regime",           "status",      "engine", "impacts",        "period",
                                      "peak_force_ratio", "impact_rate", "cycles", "observed_cycles"};

// A rigid stop, a refined map, and one with many starts or uncertain rigs each have additional fields.
job::Job with_every_field() {
    job::Job job = map_file::examples::small_map(4, 4);
    job.contact = job::Restitution{0.6};
    job.refine.levels = 1;
    job.starts.count = 4;
    job.uncertainty.rigs = 64;
    job.certificate = {.cells = job::every_cell, .attractors = true};
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

TEST(OutputFields, EveryOptionalFieldBringsARowAndEveryRowHasItsOwnName) {
    job::Job job = with_every_field();
    const std::vector<std::string> all = names(stored_fields(job));
    EXPECT_EQ(all.size(), cell::quantities.size() - 12)
        << "all but the jump of a sweep, the kick and the life of a cell without [starts], and the forces of "
           "drawn rigs, "
           "whose speeds "
           "take their place on a rigid stop";
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
    job.output.fields = {};
    const std::vector<std::string> usual = names_of_cell_and_attractors(job);
    for (const auto& field : job::Names<OptionalField>::all) {
        job.output.fields = {field.value};
        const std::vector<std::string> some = names_of_cell_and_attractors(job);
        EXPECT_GT(some.size(), usual.size()) << field.name;
        const bool is_there =
            std::ranges::any_of(some, [&](const std::string& name) { return name == field.name; });
        EXPECT_TRUE(is_there || field.name == "orbit" || field.name == "force_per_cycle" ||
                    field.name.ends_with("_elasticity"))
            << field.name;
    }
}

TEST(OutputFields, AttractorsHaveFieldsOfTheirOwnWhereACellHasManyStarts) {
    job::Job job = map_file::examples::small_map(4, 4);
    EXPECT_TRUE(stored_attractor_fields(job).empty());
    job.starts.count = 4;
    const std::vector<std::string> usual{"attractor_regime",
                                         "attractor_status",
                                         "attractor_impacts",
                                         "attractor_period",
                                         "attractor_peak_force_ratio",
                                         "basin_share",
                                         "mean_life_s",
                                         "mean_life_error_s",
                                         "attractor_orbit_displacement",
                                         "attractor_orbit_velocity"};
    EXPECT_EQ(names(stored_attractor_fields(job)), usual);
    job.output.fields = {OptionalField::critical_kick};
    EXPECT_EQ(names(stored_attractor_fields(job)).size(), usual.size() + 5);
}

// A file of a job that asks for certificates of its cells alone is what it was before attractors had some.
TEST(OutputFields, AttractorsHaveCertificatesWhereThoseAreAskedFor) {
    job::Job job = map_file::examples::small_map(4, 4);
    job.starts.count = 4;
    job.certificate.cells = 7;
    const std::size_t usual = stored_attractor_fields(job).size();
    const auto of_attractors = [&] {
        const std::vector<std::string> all = names(stored_attractor_fields(job));
        return std::vector(all.begin() + static_cast<std::ptrdiff_t>(usual), all.end());
    };
    EXPECT_TRUE(of_attractors().empty());
    job.certificate.attractors = true;
    EXPECT_EQ(of_attractors(),
              (std::vector<std::string>{"attractor_certified", "attractor_peak_force_lower_ratio",
                                        "attractor_peak_force_upper_ratio", "attractor_stability_margin"}));
    job.contact = job::Restitution{0.6};
    EXPECT_EQ(of_attractors().size(), 6U);
    job.certificate.cells = 0;  // as check foretells the cost
    EXPECT_TRUE(of_attractors().empty());
}

TEST(OutputFields, AKickIsOfTheCellWithoutManyStartsAndOfItsAttractorsWithThem) {
    job::Job job = map_file::examples::small_map(4, 4);
    job.output.fields = {OptionalField::critical_kick};
    EXPECT_TRUE(std::ranges::count(names(stored_fields(job)), "critical_kick_phase") > 0);
    job.starts.count = 4;
    EXPECT_FALSE(std::ranges::count(names(stored_fields(job)), "critical_kick_phase") > 0);
}

// They are read unchanged.
TEST(OutputFields, FilesOfLayoutTwoHaveNoneThatCameLater) {
    job::Job job = with_every_field();
    job.layout = 2;
    const std::vector<std::string> all = names_of_cell_and_attractors(job);
    EXPECT_TRUE(std::ranges::count(all, "critical_kick") > 0);
    for (const char* name : {"attractor_status", "critical_kick_phase", "attractor_orbit_velocity"}) {
        EXPECT_FALSE(std::ranges::count(all, name) > 0) << name;
    }
}

TEST(OutputFields, AttractorsComeBackFromTheirBytesInTheUnitsOfTheFile) {
    job::Job job = with_every_field();
    const scene::Scales scales{.length_m = 2, .frequency_rad_per_s = 3, .force_n = 5, .weight_n = 7};
    cell::CellAttractor computed{regime::Regime::periodic, regime::Status::imprecise, 3, 2, 14, 0.25};
    computed.kick = {0.5, 1.25, 0.75, -1, 0.125};
    computed.certified = cell::Certified::near_grazing;
    computed.force_lower = 1.5;  // bounds have the file's units already
    computed.impact_speed_upper = 2.5;
    computed.stability_margin = 0.375;
    const std::vector<StoredAttractor> stored{in_file_units(computed, scales), {}};
    const auto fields = stored_attractor_fields(job);
    const std::vector<StoredAttractor> back = map_file::decode(fields, map_file::encode(fields, stored), 2);
    EXPECT_EQ(back[0].regime, regime::Regime::periodic);
    EXPECT_EQ(back[0].impacts, 3);
    EXPECT_EQ(back[0].period, 2);
    EXPECT_EQ(back[0].peak_force, 10);
    EXPECT_EQ(back[0].share, 0.25);
    EXPECT_EQ(back[0].status, regime::Status::imprecise);
    EXPECT_EQ(back[0].kick.size, 3);
    EXPECT_EQ(back[0].kick.phase, 1.25);
    EXPECT_EQ(back[0].kick.tried, 4.5);
    EXPECT_EQ(back[0].kick.direction, -1);
    EXPECT_EQ(back[0].kick.lower, 0.75);
    EXPECT_EQ(back[0].certified, cell::Certified::near_grazing);
    EXPECT_EQ(back[0].force_lower, 1.5);
    EXPECT_EQ(back[0].impact_speed_upper, 2.5);
    EXPECT_EQ(back[0].stability_margin, 0.375);
    for (const AttractorField& field : fields) {  // an empty slot
        const double value = field.quantity->load(back[1]);
        EXPECT_TRUE(value == field.variable.fill || (std::isnan(value) && std::isnan(field.variable.fill)))
            << field.variable.name;
    }
}

// Of drawn rigs, and of elasticities, a job stores those of forces or of speeds, in the same members.
bool take_each_others_place(const cell::Quantity& one, const cell::Quantity& other) {
    if (one.keeping.by_number != nullptr && other.keeping.by_number != nullptr && &one != &other)
        return std::string(one.keeping.by_number) == other.keeping.by_number;
    using enum cell::StoredWhen;
    const auto are = [&](cell::StoredWhen a, cell::StoredWhen b) {
        return one.keeping.kept == a && other.keeping.kept == b;
    };
    return are(of_uncertain_rigs_with_forces, of_uncertain_rigs_on_rigid_stops) ||
           are(of_uncertain_rigs_on_rigid_stops, of_uncertain_rigs_with_forces);
}

TEST(OutputFields, EachRowStoresAMemberOfItsOwn) {
    for (const cell::Quantity& changed : cell::quantities) {
        regime::CellResult result;
        StoredCell stored;
        const double value = changed.load(result) == 1 ? 0 : 1;
        changed.store(result, value);
        changed.store(stored, value);
        for (const cell::Quantity& quantity : cell::quantities) {
            if (take_each_others_place(changed, quantity)) continue;
            const double expected = &quantity == &changed ? value : quantity.load(StoredCell{});
            const bool is_number = !std::isnan(expected);
            EXPECT_EQ(is_number ? quantity.load(stored) : 0, is_number ? expected : 0) << quantity.name;
            EXPECT_EQ(is_number ? quantity.load(result) : 0, is_number ? expected : 0) << quantity.name;
            EXPECT_EQ(std::isnan(quantity.load(stored)), !is_number) << changed.name << " " << quantity.name;
        }
    }
}

// Every member has a distinct value, so that two fields that store the same member are detected.
template <class Cell = regime::CellResult>
Cell distinct_cell() {
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
            .attractors = 19,
            .start_attractor = 20,
            .last_impact = 17};
}

TEST(OutputFields, EachNameStoresWhatItSays) {
    std::map<std::string, double> values;
    for (const cell::Quantity& quantity : cell::quantities)
        values[quantity.name] = quantity.load(distinct_cell());
    const std::map<std::string, double> expected{{"regime", 2},
                                                 {"status", 1},
                                                 {"computed", 0},
                                                 {"engine", 3},
                                                 {"impacts", 11},
                                                 {"period", 12},
                                                 {"jump", 0},
                                                 {"peak_force_ratio", 1.5},
                                                 {"chatter", 1},
                                                 {"impact_rate", 2.5},
                                                 {"cycles", 13},
                                                 {"observed_cycles", 18},
                                                 {"multiplier", 3.5},
                                                 {"lyapunov", 4.5},
                                                 {"sensitivity", 5.5},
                                                 {"orbit_displacement", 6.5},
                                                 {"impulse", 10.5},
                                                 {"orbit_velocity", 7.5},
                                                 {"impact_speed", 9.5},
                                                 {"contact_time", 11.5},
                                                 {"last_impact", 17},
                                                 {"contact_power_w", 12.5},
                                                 {"window_cycles", 16},
                                                 {"max_displacement", 13.5},
                                                 {"peak_force_mean_ratio", 14.5},
                                                 {"peak_force_q95_ratio", 15.5}};
    for (const auto& [name, value] : expected) EXPECT_EQ(values[name], value) << name;
}

TEST(OutputFields, CellsComeBackFromBytes) {
    const std::vector<Field> fields = stored_fields(map_file::examples::small_basin(4, 4));
    const std::vector<StoredCell> cells{distinct_cell<StoredCell>(),
                                        in_file_units(map_file::examples::made_up_cell(1, 2), {}),
                                        in_file_units(map_file::examples::made_up_cell(2, 2), {})};
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
    const std::vector<StoredCell> cells(16, in_file_units(map_file::examples::made_up_cell(3, 1), {}));
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
