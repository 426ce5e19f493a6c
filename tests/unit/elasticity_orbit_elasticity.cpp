// Elasticities of orbits, against differences of the peak force or impact speed of the engine, which shares no
// code with them: orbits solved anew with one number of the job a little larger and a little smaller.
#include "elasticity/orbit_elasticity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "certified_cells.hpp"
#include "job/axis_quantity.hpp"

namespace peterka::elasticity {
namespace {

using testing::SolvedPlace;

certificate::StroboscopicOrbit orbit_of(const regime::CellResult& cell) {
    return testing::claim_of(cell).orbit;
}

// F in N, or the largest impact speed in m/s.
double result_of(const SolvedPlace& place) {
    const scene::Scales scales = scene::scales_of(place.numbers);
    if (job::is_rigid(place.numbers.contact))
        return place.cell.impact_speed * scales.length_m * scales.frequency_rad_per_s;
    return place.cell.peak_force * scales.force_n;
}

// The place is physical: in Hz and m, whatever the rig.
SolvedPlace solved_with(const SolvedPlace& place, std::string_view key, double factor) {
    job::CellNumbers numbers = place.numbers;
    numbers.place.frequency_hz = number_of(place.numbers, "frequency_hz");
    numbers.place.gap_m = number_of(place.numbers, "gap_m");
    const double value = number_of(numbers, key);
    set_number(numbers, key, value * factor);
    return testing::solved(numbers);
}

// Nothing where a label changes within the difference, or the result isn't smooth there.
std::optional<double> by_differences(const SolvedPlace& place, std::string_view key) {
    const auto difference = [&](double h) -> std::optional<double> {
        const SolvedPlace up = solved_with(place, key, 1 + h);
        const SolvedPlace down = solved_with(place, key, 1 - h);
        if (!same_label(up.cell, place.cell) || !same_label(down.cell, place.cell)) return std::nullopt;
        return (result_of(up) - result_of(down)) / (2 * h * result_of(place));
    };
    constexpr double h = 5e-5;
    const auto fine = difference(h);
    const auto coarse = difference(2 * h);
    if (!fine || !coarse || std::abs(*fine - *coarse) > 1e-3 * (std::abs(*fine) + 0.01)) return std::nullopt;
    return (4 * *fine - *coarse) / 3;
}

class OrbitElasticity : public ::testing::TestWithParam<testing::Stop> {};

TEST_P(OrbitElasticity, IsThatOfTheEnginesOrbits) {
    const auto cells = testing::cells_of(regime::Regime::periodic, 7, GetParam().law);
    ASSERT_GT(cells.size(), 12U);
    std::map<std::string_view, int> compared;
    int chatters = 0;
    for (const SolvedPlace& place : cells) {
        const auto of_orbit = orbit_elasticity(place.numbers, orbit_of(place.cell));
        if (!of_orbit) continue;
        chatters += place.cell.chatter ? 1 : 0;
        for (const std::string_view key : job::axis_keys(law_of(GetParam().law))) {
            if (key.starts_with("start.") || key.ends_with("_ratio") || key.find("cubic") != key.npos) continue;
            const double elasticity = elasticity_by(key, place.numbers, *of_orbit);
            const auto expected = by_differences(place, key);
            if (!expected) continue;
            ++compared[key];
            EXPECT_NEAR(elasticity, *expected, 2e-6 * (std::abs(*expected) + 1))
                << key << " at " << place.numbers.place.frequency_ratio << ", "
                << place.numbers.place.gap_ratio;
        }
    }
    for (const auto& [key, count] : compared) EXPECT_GT(count, 10) << key;
    if (GetParam().name == "Rigid032") {
        EXPECT_GT(chatters, 0);
    }
    EXPECT_GE(compared.size(), 7U);
}

INSTANTIATE_TEST_SUITE_P(Stops, OrbitElasticity, ::testing::ValuesIn(testing::stops),
                         [](const auto& stop) { return stop.param.name; });

// The unit of time or of length alone may be changed: the force scales with the numbers that have it.
TEST(OrbitElasticityOfNumbers, ObeysTheirDimensions) {
    for (const SolvedPlace& place : testing::cells_of(regime::Regime::periodic, 7)) {
        const auto of_orbit = orbit_elasticity(place.numbers, orbit_of(place.cell));
        if (!of_orbit) continue;
        const auto by = [&](std::string_view key) { return elasticity_by(key, place.numbers, *of_orbit); };
        EXPECT_NEAR(by("cart.amplitude_m") + by("gap_m"), 1, 1e-9);  // F ~ length
        EXPECT_NEAR(by("hammer.mass_kg") + by("hammer.damping_ns_per_m") + by("contact.stiffness_n_per_m") +
                        by("contact.damping_ns_per_m"),
                    1, 1e-7);  // F ~ mass, at one natural frequency
        EXPECT_NEAR(by("frequency_hz") + by("hammer.natural_frequency_hz") + by("hammer.damping_ns_per_m") +
                        2 * by("contact.stiffness_n_per_m") + by("contact.damping_ns_per_m"),
                    2, 1e-7);  // F ~ 1/time^2
    }
}

TEST(OrbitElasticityOfNumbers, IsZeroByANumberThatIsZero) {
    SolvedPlace place = testing::solved_at(2, 0);
    ASSERT_EQ(place.cell.regime, regime::Regime::periodic);
    const auto of_orbit = orbit_elasticity(place.numbers, orbit_of(place.cell));
    ASSERT_TRUE(of_orbit);
    EXPECT_EQ(elasticity_by("gap_m", place.numbers, *of_orbit), 0);
    EXPECT_EQ(elasticity_by("hammer.cubic_stiffness_n_per_m3", place.numbers, *of_orbit), 0);
    EXPECT_NEAR(elasticity_by("cart.amplitude_m", place.numbers, *of_orbit), 1, 1e-9);
}

TEST(OrbitElasticityOfNumbers, IsNothingForAnOtherLabelAndForAnotherLaw) {
    SolvedPlace place = testing::solved_at(2, 0.5);
    ASSERT_EQ(place.cell.regime, regime::Regime::periodic);
    certificate::StroboscopicOrbit other = orbit_of(place.cell);
    ++other.impacts;
    EXPECT_FALSE(orbit_elasticity(place.numbers, other));
    place.numbers.contact = job::HuntCrossley{5.5e8, 1.5, 0.3};
    EXPECT_FALSE(orbit_elasticity(place.numbers, orbit_of(place.cell)));
}

// The fold of 1/1 at gap/A0 = 1.5 lies at 1.862464993, by the curves' equations: towards it elasticities grow
// as 1/sqrt(distance), until none is told.
TEST(OrbitElasticityOfNumbers, GrowsTowardsAFoldAndIsNothingAtIt) {
    constexpr double fold = 1.862464993;
    SolvedPlace place = testing::solved(testing::numbers_170mm(1.8, 1.5), 0, 4);
    std::vector<double> scaled;
    bool ends = false;
    for (int n = 4; n < 40 && !ends; ++n) {
        const double distance = std::exp2(-n);
        const double frequency = fold - distance;
        place = testing::solved(testing::numbers_170mm(frequency, 1.5), place.cell.orbit_displacement,
                                place.cell.orbit_velocity + frequency);
        ASSERT_EQ(place.cell.impacts, 1) << n;
        const auto of_orbit = orbit_elasticity(place.numbers, orbit_of(place.cell));
        ends = !of_orbit;
        if (of_orbit) scaled.push_back(elasticity_by("gap_m", place.numbers, *of_orbit) * std::sqrt(distance));
    }
    EXPECT_TRUE(ends);
    ASSERT_GT(scaled.size(), 14U);
    EXPECT_NEAR(scaled[14] / scaled[12], 1, 0.02);
}

// With strong cubic springs, of either form: the engine that keeps them, at a fine tolerance.
TEST(OrbitElasticityOfNumbers, IncludesTheCubicSpring) {
    for (const job::CubicForm form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        job::Job job = testing::job_170mm(0);
        job.hammer.cubic_stiffness_n_per_m3 = 2e6;
        job.hammer.cubic = form;
        const auto solved = [&](const job::CellNumbers& numbers) {
            const scene::Oscillator<double> oscillator = testing::oscillator_at(numbers);
            return SolvedPlace{
                numbers, regime::find_steady_state(oscillator, testing::start_at(oscillator, 0, 0), {},
                                                   {.engine = regime::Engine::cvode, .tolerance = 1e-12})};
        };
        job::CellNumbers numbers = job::numbers_in(job);
        numbers.place = {.frequency_hz = 9.3, .gap_m = 0.3e-3};
        const SolvedPlace place = solved(numbers);
        ASSERT_EQ(place.cell.regime, regime::Regime::periodic);
        const auto of_orbit = orbit_elasticity(numbers, orbit_of(place.cell));
        ASSERT_TRUE(of_orbit);
        EXPECT_NEAR(of_orbit->largest / place.cell.peak_force, 1, 1e-8);
        for (const std::string_view key : {"hammer.cubic_stiffness_n_per_m3", "cart.amplitude_m",
                                           "frequency_hz", "gap_m", "hammer.mass_kg"}) {
            constexpr double h = 1e-3;
            const auto result = [&](double factor) {
                job::CellNumbers changed = numbers;
                set_number(changed, key, factor * number_of(numbers, key));
                return result_of(solved(changed));
            };
            const auto difference = [&](double step) {
                return (result(1 + step) - result(1 - step)) / (2 * step * result_of(place));
            };
            const double expected = (4 * difference(h) - difference(2 * h)) / 3;
            EXPECT_NEAR(elasticity_by(key, numbers, *of_orbit), expected, 1e-6 * (1 + std::abs(expected)))
                << key;
        }
    }
}

}  // namespace
}  // namespace peterka::elasticity
