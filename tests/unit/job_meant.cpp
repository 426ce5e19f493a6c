// The key that is meant by an unknown one, and its unit.
#include "job/meant.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "job/misspelt_tables.hpp"

namespace peterka::job {
namespace {

const std::vector<std::string_view> known{"mass_kg",
                                          "natural_frequency_hz",
                                          "stiffness_n_per_m",
                                          "damping_ratio",
                                          "damping_ns_per_m",
                                          "gap_ratio",
                                          "gap_m",
                                          "frequency_ratio",
                                          "frequency_hz",
                                          "velocity_m_per_s",
                                          "impact_window_s",
                                          "cubic_stiffness_n_per_m3"};

std::string question(std::string_view unknown) {
    return meant_by(unknown, known).question();
}

TEST(Meant, TellsTheUnitOfTheKeyThatIsMeantWhereItIsAnother) {
    EXPECT_EQ(question("gap_mm"), "did you mean gap_m, in metres?");
    EXPECT_EQ(question("mass_g"), "did you mean mass_kg, in kilograms?");
    EXPECT_EQ(question("natural_frequency_rad_per_s"), "did you mean natural_frequency_hz, in hertz?");
    EXPECT_EQ(question("frequency_rpm"), "did you mean frequency_hz, in hertz?");
    EXPECT_EQ(question("stiffness_n_per_mm"), "did you mean stiffness_n_per_m, in N/m?");
    EXPECT_EQ(question("cubic_stiffness_n_per_mm3"), "did you mean cubic_stiffness_n_per_m3, in N/m^3?");
    EXPECT_EQ(question("damping_kg_per_s"), "did you mean damping_ns_per_m, in Ns/m?");
    EXPECT_EQ(question("damping_percent"), "did you mean damping_ratio, a ratio?");
    EXPECT_EQ(question("velocity_mm_per_s"), "did you mean velocity_m_per_s, in m/s?");
    EXPECT_EQ(question("impact_window_ms"), "did you mean impact_window_s, in seconds?");
}

TEST(Meant, TellsNoUnitWhereTheUnknownKeyHasTheSameOrNone) {
    EXPECT_EQ(question("mas_kg"), "did you mean mass_kg?");
    EXPECT_EQ(question("mass"), "did you mean mass_kg?");
    EXPECT_EQ(question("gapp_m"), "did you mean gap_m?");
    EXPECT_FALSE(meant_by("colour", known).found());
}

TEST(Meant, IsAskedForWithItsTable) {
    EXPECT_EQ(meant_by("gap_mm", known).question("[axes.", "]"), "did you mean [axes.gap_m], in metres?");
}

TEST(MisspeltTables, AreNamesWithALetterWrong) {
    EXPECT_TRUE(is_misspelt("hamer", "hammer"));
    EXPECT_TRUE(is_misspelt("crat", "cart"));
    EXPECT_TRUE(is_misspelt("contcat", "contact"));
    EXPECT_TRUE(is_misspelt("uncertanity", "uncertainty"));
    EXPECT_FALSE(is_misspelt("start", "cart")) << "a table of other jobs";
    EXPECT_FALSE(is_misspelt("gap", "gap_ratio"));
    EXPECT_FALSE(is_misspelt("car", "card_"));
}

}  // namespace
}  // namespace peterka::job
