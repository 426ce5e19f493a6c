// What many starts show, in words.
#include "report/starts_summary.hpp"

#include <gtest/gtest.h>

#include "map_examples.hpp"

namespace peterka {
namespace {

std::string text_of(const findings::StartCounts& counts) {
    job::Job job = map_file::examples::small_map(3, 5);
    job.starts.count = 30;
    return starts_summary(scene::Scene(job), {counts, {}});
}

TEST(StartsSummary, GivesSharesOfTheCells) {
    findings::StartCounts counts;
    counts.cells = 200;
    counts.by_number[1] = 150;
    counts.mixed = 50;
    counts.never_hit = 26;
    counts.minority = 8;
    counts.known_hit = 3;
    const std::string text = text_of(counts);
    for (const char* words :
         {"attractors of a cell: 1: 75.0 %\n",
          "motions with impacts and without: 25.0 % of the cells; none with impacts is known: 13.0 %\n",
          "known, though no start ended on it: one with impacts in 3 cells\n",
          "[start] ends on another attractor than most starts in 4.0 % of the cells\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_EQ(text.find("motion without impacts in"), std::string::npos) << text;
    EXPECT_EQ(text.find("mean life"), std::string::npos) << text;
}

// The first column's frequency is half of 4.5 Hz: 4 s are 9 cycles.
TEST(StartsSummary, TellsTheShortestMeanLifeOfChaos) {
    findings::StartCounts counts;
    counts.cells = 15;
    counts.dying = 2;
    counts.shortest = {.seconds = 4, .error = 0.5, .row = 0, .column = 0};
    const std::string text = text_of(counts);
    EXPECT_NE(text.find("escape: 2; its mean life, where it is shortest: 4 +- 0.5 s, 9 cycles\n"),
              std::string::npos)
        << text;
}

TEST(StartsSummary, IsEmptyWithoutStartsOrCells) {
    EXPECT_EQ(text_of({}), "");
    findings::StartCounts counts;
    counts.cells = 1;
    EXPECT_EQ(starts_summary(scene::Scene(map_file::examples::small_map(3, 5)), {counts, {}}), "");
}

}  // namespace
}  // namespace peterka
