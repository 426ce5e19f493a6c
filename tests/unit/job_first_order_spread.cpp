// The spread of a result to first order, against the law of propagation for independent and for correlated
// numbers (JCGM 100:2008, 5.1 and 5.2).
#include "job/first_order_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "job_examples.hpp"

namespace peterka::job {
namespace {

const std::vector<Elasticity> of_three{{.key = "contact.stiffness_n_per_m", .value = 0.5},
                                       {.key = "contact.damping_ns_per_m", .value = -2},
                                       {.key = "hammer.mass_kg", .value = 0.25}};

Job with_spreads(std::int64_t rigs) {
    Job job = examples::map();
    job.uncertainty.rigs = rigs;
    job.uncertainty.numbers["contact.stiffness_n_per_m"].relative = 0.06;
    job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.02;
    return job;
}

TEST(FirstOrderSpread, IndependentNumbersAddTheirVariances) {
    for (const std::int64_t rigs : {1, 48}) {
        const Job job = with_spreads(rigs);
        const auto spread = first_order_spread(job, numbers_at(job, 0, 0), of_three);
        ASSERT_TRUE(spread) << rigs;
        EXPECT_NEAR(spread->deviation, std::hypot(0.03, 0.04), 1e-15);
        EXPECT_NEAR(spread->shares[0], 9.0 / 25, 1e-14);
        EXPECT_NEAR(spread->shares[1], 16.0 / 25, 1e-14);
        EXPECT_EQ(spread->shares[2], 0);
    }
}

TEST(FirstOrderSpread, ThereIsNoneWithoutRigs) {
    const Job job = with_spreads(0);
    EXPECT_FALSE(first_order_spread(job, numbers_at(job, 0, 0), of_three));
}

// A number that is proportional to another adds its deviation, not its variance.
TEST(FirstOrderSpread, FullyCorrelatedNumbersAddTheirDeviations) {
    Job job = examples::map();
    const CellNumbers own = numbers_at(job, 0, 0);
    const double stiffness = number_of(own, "contact.stiffness_n_per_m");
    const double mass = number_of(own, "hammer.mass_kg");
    const double a = 0.06 * stiffness;
    const double b = 0.04 * mass;
    job.uncertainty.rigs = 8;
    job.uncertainty.covariance = {.of = {"contact.stiffness_n_per_m", "hammer.mass_kg"},
                                  .mean = {stiffness, mass},
                                  .matrix = {{a * a, a * b}, {a * b, b * b}}};
    const auto spread = first_order_spread(job, own, of_three);
    ASSERT_TRUE(spread);
    EXPECT_NEAR(spread->deviation, 0.5 * 0.06 + 0.25 * 0.04, 1e-14);
    EXPECT_NEAR(spread->shares[0], 0.03 / 0.04, 1e-13);
    EXPECT_NEAR(spread->shares[2], 0.01 / 0.04, 1e-13);
}

// A uniform number's variance is the square of its width over 12.
TEST(FirstOrderSpread, AUniformNumberHasTheVarianceOfItsWidth) {
    Job job = examples::map();
    job.uncertainty.rigs = 8;
    const double mass = number_of(numbers_at(job, 0, 0), "hammer.mass_kg");
    job.uncertainty.numbers["hammer.mass_kg"] = {.from = 0.9 * mass, .to = 1.1 * mass};
    const auto spread = first_order_spread(job, numbers_at(job, 0, 0), of_three);
    ASSERT_TRUE(spread);
    EXPECT_NEAR(spread->deviation, 0.25 * 0.2 / std::sqrt(12.0), 1e-14);
    EXPECT_NEAR(spread->shares[2], 1, 1e-14);
}

}  // namespace
}  // namespace peterka::job
