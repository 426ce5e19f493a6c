// What was left out is told for what a map holds, and only for that.
#include "report/omitted.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "map_examples.hpp"

namespace peterka {
namespace {

TEST(Omitted, TellsWhatNoCellNeeded) {
    job::Job job = map_file::examples::small_map(3, 5);
    findings::Statistics statistics;
    statistics.counts.by_engine[static_cast<std::size_t>(cell::Engine::exact)] = 15;
    const auto told = [&](const char* words) {
        const auto sentences = omitted_in_words(job, statistics);
        return std::ranges::count_if(
            sentences, [&](const std::string& one) { return one.find(words) != std::string::npos; });
    };
    EXPECT_EQ(told("the rest of each trajectory once its regime is verified"), 1);
    EXPECT_EQ(told("peak forces of transients"), 1);
    EXPECT_EQ(told("SUNDIALS is not called"), 1);
    EXPECT_EQ(told("filled from computed ones"), 0);
    statistics.counts.filled = 4;
    statistics.counts.by_engine[static_cast<std::size_t>(cell::Engine::cvode)] = 1;
    EXPECT_EQ(told("SUNDIALS is not called"), 0);
    EXPECT_EQ(told("4 cells: filled from computed ones"), 1);
    job.contact = job::Restitution{0.5};
    EXPECT_EQ(told("peak forces of transients"), 0);  // there are none at all
}

}  // namespace
}  // namespace peterka
