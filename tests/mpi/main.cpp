// Runs the tests of collective functions on all ranks; the exit code is that of the worst rank.
//
// Every rank runs every test. A rank that leaves a test early would deadlock ranks still waiting in it, so
// values to compare are gathered first and asserted afterwards.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

#include "hdf5/checked.hpp"

namespace {

// For all ranks but the first, which reports progress.
class FailuresOnly : public testing::EmptyTestEventListener {
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (!result.failed()) return;
        std::fprintf(stderr, "%s:%d: %s\n", result.file_name(), result.line_number(), result.summary());
    }
};

}  // namespace

int main(int argc, char** argv) {
    peterka::hdf5::leave_open_files_alone();
    MPI_Init(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) {
        testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new FailuresOnly);
    }
    int outcome = RUN_ALL_TESTS();
    MPI_Allreduce(MPI_IN_PLACE, &outcome, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return outcome;
}
