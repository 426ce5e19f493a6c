// `--set table.key=value`: its effect, and that the last one wins.
#include <gtest/gtest.h>

#include "job/read.hpp"
#include "job/write.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

Job map_with(std::vector<std::string> overrides) {
    return read_job_text(resolved_text(examples::map()), "map", overrides);
}

TEST(Override, SetsNumbersWordsAndLists) {
    Job expected = examples::map();
    expected.rows.points = 64;
    expected.hammer.mass_kg = 1;
    expected.solver.engine = EngineChoice::automatic;
    expected.output.fields = {OptionalField::lyapunov};
    expected.title = "x";
    EXPECT_EQ(map_with({"axes.gap_ratio.points=64", "hammer.mass_kg=1", "solver.engine=\"auto\"",
                        "output.fields=[\"lyapunov\"]", "title=\"x\""}),
              expected);
}

TEST(Override, ABareWordIsTextWhereTextIsExpected) {
    Job expected = examples::map();
    expected.title = "Peterka map # 170 mm, \"fine\" = good";
    expected.solver.engine = EngineChoice::automatic;
    EXPECT_EQ(map_with({"title=Peterka map # 170 mm, \"fine\" = good", "solver.engine=auto"}), expected);
}

TEST(Override, ALineBreakLetsInNoSecondKey) {
    EXPECT_THROW((void)map_with({"title=\"x\"\nschema = 1"}), JobFaults);
}

TEST(Override, SpacesAroundKeyAndValueDoNotMatter) {
    EXPECT_EQ(map_with({" cart.amplitude_m =  2e-3 "}).cart.amplitude_m, 2e-3);
}

TEST(Override, TheLaterOneCounts) {
    EXPECT_EQ(map_with({"cart.amplitude_m=-1", "cart.amplitude_m=2e-3"}).cart.amplitude_m, 2e-3);
}

TEST(Override, MakesATableThatTheFileDoesNotHave) {
    const auto file = examples::source_folder() / "jobs/smoke.toml";
    ASSERT_EQ(examples::content_of(file).find("[start]"), std::string::npos);
    const std::vector<std::string> overrides{"start.velocity_ratio=2"};
    EXPECT_EQ(read_job_file(file, overrides).start, (Start{0, 2}));
}

TEST(Override, ReplacesATableGivenWhole) {
    EXPECT_EQ(map_with({"axes.gap_ratio={from=1, to=2, points=3}"}).rows, (Axis{1, 2, 3, Spacing::linear}));
}

// A file with a [start] remains a map: an override sets values and removes nothing.
TEST(Override, MakesAMapWithoutAStartABasin) {
    const auto file = examples::source_folder() / "jobs/smoke.toml";
    const std::vector<std::string> overrides{
        "kind=basin", "operating_point={frequency_ratio=1.8, gap_ratio=1.6}",
        "axes={displacement_ratio={from=-6, to=6, points=4}, velocity_ratio={from=-5, to=5, points=6}}"};
    const Job basin = read_job_file(file, overrides);
    EXPECT_EQ(basin.kind, Kind::basin);
    EXPECT_EQ(basin.rows, (Axis{-5, 5, 6}));
    EXPECT_EQ(basin.operating_point, (OperatingPoint{1.8, 1.6}));
}

}  // namespace
}  // namespace peterka::job
