// The joint memory requirement of the ranks of one machine.
#include "run/require_memory.hpp"

#include <gtest/gtest.h>

#include "job/read.hpp"
#include "run/price.hpp"

namespace peterka {
namespace {

job::Job map_with_starts() {
    return job::read_job_text(R"(schema = 1
kind = "map"
title = "large"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ns_per_m = 0.06
[cart]
amplitude_m = 0.89e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 5.5e6
damping_ns_per_m = 1.2e3
[axes.frequency_ratio]
from = 0.5
to = 4.5
points = 256
[axes.gap_ratio]
from = 0.0
to = 5.0
points = 256
[starts]
count = 1000
displacement_ratio = [-4.0, 1.0]
velocity_ratio = [-4.0, 4.0]
)",
                              "large.toml");
}

TEST(RequireMemory, WhatIsLeftIsForAllRanksOfAMachine) {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const job::Job job = map_with_starts();
    const std::int64_t needed = memory_per_rank(job) - resident_bytes();
    const MemoryLeft for_one_and_a_half{needed * 3 / 2, MemoryLimit::control_group};
    const MemoryLeft for_all{needed * (ranks + 1), MemoryLimit::machine};
    const auto lack = lack_of_memory(job, MPI_COMM_WORLD, for_one_and_a_half);
    const auto none = lack_of_memory(job, MPI_COMM_WORLD, for_all);
    EXPECT_EQ(lack.has_value(), ranks > 1);
    EXPECT_FALSE(none.has_value());
    if (!lack) return;
    EXPECT_EQ(lack->ranks, ranks);
    EXPECT_NEAR(static_cast<double>(lack->needed_by_each), static_cast<double>(needed), 5e6);
    EXPECT_EQ(lack->left.by, MemoryLimit::control_group);
    EXPECT_NE(lack->host[0], 0);
}

// All ranks learn that one machine has too little.
TEST(RequireMemory, OneMachineThatLacksMemoryIsEnough) {
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const MemoryLeft left = rank == ranks - 1 ? MemoryLeft{1000, MemoryLimit::machine} : MemoryLeft{};
    const auto lack = lack_of_memory(map_with_starts(), MPI_COMM_WORLD, left);
    ASSERT_TRUE(lack.has_value());
    EXPECT_EQ(lack->left.bytes, 1000);
}

}  // namespace
}  // namespace peterka
