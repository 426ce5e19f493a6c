// The numbers of cells, by place and by name.
#include "job/cell_numbers.hpp"

#include <gtest/gtest.h>

#include "job_examples.hpp"

namespace peterka::job {
namespace {

TEST(CellNumbers, AStudyHasACellForEachPairInEitherUnit) {
    Job job = examples::map();
    job.kind = Kind::study;
    job.study.frequency_ratio = {2, 1.5, 3};
    job.study.gap_ratio = {0, 1, 2};
    const auto ratios = numbers_of_cells(job);
    ASSERT_EQ(ratios.size(), 3U);
    for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_DOUBLE_EQ(ratios[n].frequency_ratio(), job.study.frequency_ratio[n]);
        EXPECT_DOUBLE_EQ(ratios[n].gap_ratio(), job.study.gap_ratio[n]);
    }
    job.study.frequency_hz = {9};
    job.study.gap_m = {1e-3};
    const auto in_si = numbers_of_cells(job);
    ASSERT_EQ(in_si.size(), 1U);
    EXPECT_EQ(in_si[0].place.frequency_hz, 9);
    EXPECT_EQ(in_si[0].place.gap_m, 1e-3);
}

TEST(CellNumbers, NamesOfNumbersThatAreGiven) {
    const CellNumbers numbers = numbers_at(examples::map(), 0, 0);
    EXPECT_TRUE(gives_number(numbers, "contact.stiffness_n_per_m"));
    EXPECT_TRUE(gives_number(numbers, "gap_ratio"));
    EXPECT_TRUE(gives_number(numbers, "frequency_hz"));
    EXPECT_FALSE(gives_number(numbers, "contact.exponent"));
    EXPECT_FALSE(gives_number(numbers, "contact"));
    EXPECT_FALSE(gives_number(numbers, "nothing.at_all"));
    EXPECT_FALSE(gives_number(numbers, "x"));
}

}  // namespace
}  // namespace peterka::job
