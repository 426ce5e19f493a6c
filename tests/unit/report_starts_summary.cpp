// What many starts show, in words.
#include "report/summary_parts.hpp"

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
         {"attractors on which they end: 1: 75.0 %\n",
          "motions with impacts and without: 25.0 % of the cells; none with impacts is known: 13.0 %\n",
          "known, though no start ended on it: one with impacts in 3 cells\n",
          "[start] ends on another attractor than most starts in 4.0 % of the cells\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_EQ(text.find("motion without impacts in"), std::string::npos) << text;
    EXPECT_EQ(text.find("mean life"), std::string::npos) << text;
}

// Of two starts, each ends elsewhere with probability 1 - s: both do in half of the cells where s = 29.3 %.
TEST(StartsSummary, TellsWhatSoManyStartsMiss) {
    job::Job job = map_file::examples::small_map(3, 5);
    job.starts.count = 2;
    findings::StartCounts counts;
    counts.cells = 15;
    const std::string text = starts_summary(scene::Scene(job), {counts, {}});
    EXPECT_NE(text.find("takes 29 % of the rectangle in every second cell"), std::string::npos) << text;
    EXPECT_NE(text.find("90 % in one cell of a hundred"), std::string::npos) << text;
}

TEST(StartsSummary, SaysWhereMoreAreFoundThanKept) {
    findings::StartCounts counts;
    counts.cells = 200;
    EXPECT_EQ(text_of(counts).find("none of the attractors"), std::string::npos) << text_of(counts);
    EXPECT_EQ(text_of(counts).find("have more attractors"), std::string::npos) << text_of(counts);
    counts.not_kept = 1;
    counts.left_over = 3;
    EXPECT_NE(text_of(counts).find(
                  "among them those that end on none of the attractors that are kept: 0.5 % of the cells\n"),
              std::string::npos)
        << text_of(counts);
    EXPECT_NE(text_of(counts).find("3 cells have more attractors than"), std::string::npos) << text_of(counts);
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

TEST(StartsSummary, TellsHowManyStartsFail) {
    findings::StartCounts counts;
    counts.cells = 200;
    EXPECT_EQ(text_of(counts).find("fail"), std::string::npos) << text_of(counts);
    counts.failing = 3;
    counts.most_failing = 0.4;
    EXPECT_NE(text_of(counts).find("(failed): in 1.5 % of the cells,\n  up to 40 % of a cell's starts\n"),
              std::string::npos)
        << text_of(counts);
}

TEST(StartsSummary, IsEmptyWithoutStartsOrCells) {
    EXPECT_EQ(text_of({}), "");
    findings::StartCounts counts;
    counts.cells = 1;
    EXPECT_EQ(starts_summary(scene::Scene(map_file::examples::small_map(3, 5)), {counts, {}}), "");
}

}  // namespace
}  // namespace peterka
