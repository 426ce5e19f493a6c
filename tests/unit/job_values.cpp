// Axes, derived numbers, words and numbers as text.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/derived.hpp"
#include "job/names.hpp"
#include "job/nearest.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {
namespace {

TEST(AxisValue, IsThatOfNumpyLinspace) {
    // numpy.linspace(0.5, 4.5, 512)[[1, 7, 100, 510]] and numpy.linspace(-6, 6, 11)[[3, 5, 7]]
    const Axis axis{0.5, 4.5, 512};
    EXPECT_EQ(axis_value(axis, 1), 0.5078277886497065);
    EXPECT_EQ(axis_value(axis, 7), 0.5547945205479452);
    EXPECT_EQ(axis_value(axis, 100), 1.2827788649706457);
    EXPECT_EQ(axis_value(axis, 510), 4.492172211350294);
    const Axis starts{-6, 6, 11};
    EXPECT_EQ(axis_value(starts, 3), -2.4000000000000004);
    EXPECT_EQ(axis_value(starts, 5), 0.0);
    EXPECT_EQ(axis_value(starts, 7), 2.4000000000000004);
}

TEST(AxisValue, EndsAreExactAndValuesGrow) {
    for (const Axis& axis : {Axis{0.1, 0.7, 7}, Axis{-0.3, 1e5, 1000}, Axis{0.1, 0.7, 7, Spacing::log},
                             Axis{1e-6, 1e6, 999, Spacing::log}, Axis{3, 3.0000001, 2, Spacing::log}}) {
        const auto values = axis_values(axis);
        ASSERT_EQ(values.size(), static_cast<std::size_t>(axis.points));
        EXPECT_EQ(values.front(), axis.from);
        EXPECT_EQ(values.back(), axis.to);
        for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(values[i - 1], values[i]);
    }
}

TEST(AxisValue, LogarithmicAxisHasEqualRatios) {
    const Axis axis{0.01, 100, 9, Spacing::log};
    for (std::int64_t i = 0; i < 9; ++i) {
        const double exact = std::pow(10.0, -2 + 0.5 * static_cast<double>(i));
        // exp turns the rounding of a logarithm of size 5 into a few ulps.
        EXPECT_NEAR(axis_value(axis, i) / exact, 1, 8 * std::numeric_limits<double>::epsilon());
    }
}

TEST(Axis, ResolvesItsPointsUnlessTheyAreRoundingNeighbours) {
    EXPECT_TRUE(resolves_its_points({0, 5, 2147483647}));
    EXPECT_TRUE(resolves_its_points({1, 1 + 1e-9, 1000}));
    EXPECT_FALSE(resolves_its_points({1, 1 + 1e-9, 1'000'000'000}));
    EXPECT_TRUE(resolves_its_points({1e-6, 1e6, 2147483647, Spacing::log}));
    EXPECT_FALSE(resolves_its_points({1, 1 + 1e-13, 1000, Spacing::log}));
    EXPECT_FALSE(resolves_its_points({1e6 - 1e-4, 1e6, 10000, Spacing::log}));
}

TEST(Hammer, StiffnessAndDampingFollowWhicheverKeyGaveThem) {
    const Hammer by_frequency{.mass_kg = 0.298, .natural_frequency_hz = 4.5, .damping_ns_per_m = 0.06};
    EXPECT_DOUBLE_EQ(by_frequency.stiffness(), 238.23251103349492);
    EXPECT_EQ(by_frequency.damping(), 0.06);

    Hammer by_stiffness;
    by_stiffness.mass_kg = 2;
    by_stiffness.stiffness_n_per_m = 8;
    by_stiffness.damping_ratio = 0.25;
    EXPECT_EQ(by_stiffness.stiffness(), 8);
    EXPECT_EQ(by_stiffness.damping(), 2);  // 2 zeta sqrt(k m)

    EXPECT_EQ(derive(by_stiffness).omega_rad_per_s, 2);
    EXPECT_EQ(derive(by_stiffness).zeta, 0.25);
    const KelvinVoigt spring_dashpot{.stiffness_n_per_m = 800, .damping_ns_per_m = 12};
    EXPECT_EQ(derive(spring_dashpot, by_stiffness).kappa, 100);
    EXPECT_EQ(derive(spring_dashpot, by_stiffness).chi, 3);
    // K A0^(n-1)/k = 800 * 0.25^1.5/8 and D A0 omega = 6 * 0.25 * 2
    const HuntCrossley nonlinear{.stiffness_n_per_m_pow_n = 800, .exponent = 2.5, .dissipation_s_per_m = 6};
    EXPECT_EQ(derive(nonlinear, by_stiffness, {.amplitude_m = 0.25}).stiffness, 12.5);
    EXPECT_EQ(derive(nonlinear, by_stiffness, {.amplitude_m = 0.25}).dissipation, 3);
}

TEST(Hammer, DerivedNumbersAreFiniteAtTheEndsOfTheRanges) {
    for (const double mass : {1e-30, 1e30}) {
        for (const double other : {1e-30, 1e30}) {
            for (const double contact : {1e-30, 1e30}) {
                for (const bool by_frequency : {false, true}) {
                    Hammer hammer;
                    hammer.mass_kg = mass;
                    (by_frequency ? hammer.natural_frequency_hz : hammer.stiffness_n_per_m) = other;
                    (by_frequency ? hammer.damping_ns_per_m : hammer.damping_ratio) = 1e30;
                    const HammerNumbers numbers = derive(hammer);
                    EXPECT_TRUE(std::isfinite(numbers.omega_rad_per_s) && numbers.omega_rad_per_s > 0);
                    EXPECT_TRUE(std::isfinite(numbers.zeta));
                    const KelvinVoigtNumbers stop = derive(KelvinVoigt{contact, 1e30}, hammer);
                    EXPECT_TRUE(std::isfinite(stop.kappa) && stop.kappa > 0);
                    EXPECT_TRUE(std::isfinite(stop.chi));
                }
            }
        }
    }
}

TEST(Job, CountsItsCellsBeyond32Bits) {
    Job job;
    job.columns.points = 2147483647;
    job.rows.points = 2147483647;
    EXPECT_EQ(job.cells(), 4611686014132420609);
}

TEST(Output, KnowsWhichFieldsWereAskedFor) {
    const Output output{.fields = {OptionalField::orbit}};
    EXPECT_TRUE(output.has(OptionalField::orbit));
    EXPECT_FALSE(output.has(OptionalField::multiplier));
}

TEST(Names, AreThoseOfTheJobFile) {
    EXPECT_EQ(name(Kind::basin), "basin");
    EXPECT_EQ(name(EngineChoice::automatic), "auto");
    EXPECT_EQ(name(OptionalField::sensitivity), "sensitivity");
    const auto names_of = [](Kind kind) {
        Job job;
        job.kind = kind;
        return axis_names(job);
    };
    EXPECT_EQ(names_of(Kind::map).columns, "frequency_ratio");
    EXPECT_EQ(names_of(Kind::basin).rows, "velocity_ratio");
}

TEST(Nearest, FindsTheWordThatWasMeant) {
    const std::vector<std::string_view> known{"mass_kg", "natural_frequency_hz", "damping_ratio", "from", "to"};
    EXPECT_EQ(nearest("mass_gk", known), "mass_kg");
    EXPECT_EQ(nearest("frequency", known), "natural_frequency_hz");
    EXPECT_EQ(nearest("dampingratio", known), "damping_ratio");
    EXPECT_EQ(nearest("form", known), "from");
    EXPECT_EQ(nearest("ab", known), "");
    EXPECT_EQ(nearest("colour", known), "");
    EXPECT_EQ(nearest("", known), "");
}

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(TomlText, NumbersAreShortestAndAlwaysFloats) {
    EXPECT_EQ(toml_text(1.0), "1.0");
    EXPECT_EQ(toml_text(-0.0), "-0.0");
    EXPECT_EQ(toml_text(0.1), "0.1");
    EXPECT_EQ(toml_text(1e300), "1e+300");
    EXPECT_EQ(toml_text(std::int64_t{-3}), "-3");
}

TEST(TomlText, EscapesWhatATerminalOrAParserWouldTakeForACommand) {
    EXPECT_EQ(toml_text(std::string_view("a\"b\\c")), R"("a\"b\\c")");
    EXPECT_EQ(toml_text(std::string_view("\x1b[31m\n\x7f")), R"("\u001B[31m\u000A\u007F")");
    EXPECT_EQ(toml_text(std::string_view("\u009b1m é")), "\"\\u009B1m é\"");
    EXPECT_EQ(toml_key("mass_kg"), "mass_kg");
    EXPECT_EQ(toml_key("two words"), "\"two words\"");
    EXPECT_EQ(toml_key(""), "\"\"");
}

}  // namespace
}  // namespace peterka::job
