// Collective operations: common failure, work sharing, exchange of results.
#include "parallel/collective.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/errors.hpp"

namespace peterka::parallel {
namespace {

int ranks() {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

std::optional<Failure> failure_of(const std::function<void()>& task) {
    try {
        together(MPI_COMM_WORLD, task);
    } catch (const Failure& failure) {
        return failure;
    }
    return std::nullopt;
}

TEST(OutputCollective, FailureOfOneRankIsThrownOnAll) {
    const auto failure = failure_of([] {
        if (rank_in(MPI_COMM_WORLD) == ranks() - 1)
            throw Failure(ExitCode::output, "the last rank's disk is full");
    });
    ASSERT_TRUE(failure.has_value());
    EXPECT_STREQ(failure->what(), "the last rank's disk is full");
    EXPECT_EQ(failure->code(), ExitCode::output);
}

TEST(OutputCollective, OfSeveralFailuresAllRanksThrowTheLowest) {
    const auto failure =
        failure_of([] { throw Failure(ExitCode::output, "rank " + std::to_string(rank_in(MPI_COMM_WORLD))); });
    ASSERT_TRUE(failure.has_value());
    EXPECT_STREQ(failure->what(), "rank 0");
}

TEST(OutputCollective, OtherExceptionsAreInternalErrors) {
    const auto failure = failure_of([] { throw std::runtime_error("surprise"); });
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->code(), ExitCode::internal);
    EXPECT_STREQ(failure->what(), as_failure(std::runtime_error("surprise")).what());
}

TEST(OutputCollective, MemoryThatRanOutOnOneRankIsTold) {
    const auto failure = failure_of([] {
        if (rank_in(MPI_COMM_WORLD) == ranks() - 1) throw std::bad_alloc();
    });
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->code(), ExitCode::internal);
    EXPECT_TRUE(std::string(failure->what()).starts_with("out of memory. ")) << failure->what();
}

TEST(OutputCollective, FirstRankWorksAlone) {
    int calls = 0;
    on_first_rank(MPI_COMM_WORLD, [&] { ++calls; });
    EXPECT_EQ(calls, rank_in(MPI_COMM_WORLD) == 0 ? 1 : 0);
    EXPECT_FALSE(failure_of([] {}).has_value());
}

TEST(OutputCollective, SharesCoverEveryTileOnce) {
    for (const std::int64_t tiles : {0, 1, 3, 17, 1000}) {
        const Share mine = share_of(tiles, MPI_COMM_WORLD);
        std::vector<std::int64_t> own(static_cast<std::size_t>(mine.end - mine.first));
        std::iota(own.begin(), own.end(), mine.first);
        std::vector<std::int64_t> expected(static_cast<std::size_t>(tiles));
        std::iota(expected.begin(), expected.end(), 0);
        EXPECT_EQ(gather<std::int64_t>(own, MPI_COMM_WORLD), expected);
    }
}

TEST(OutputCollective, GatherKeepsRankOrderAndTakesEmptyContributions) {
    const int rank = rank_in(MPI_COMM_WORLD);
    const std::vector<int> mine(static_cast<std::size_t>(rank), rank);
    std::vector<int> expected;
    for (int i = 0; i < ranks(); ++i) expected.insert(expected.end(), static_cast<std::size_t>(i), i);
    EXPECT_EQ(gather<int>(mine, MPI_COMM_WORLD), expected);
}

}  // namespace
}  // namespace peterka::parallel
