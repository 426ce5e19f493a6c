// The rigs that [uncertainty] draws: their means and covariances, their ranges, and where their cells lie.
#include "job/rig_draws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "job/axis_key.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

Job one_cell(std::int64_t rigs) {
    Job job;
    job.hammer = {.mass_kg = 0.298, .natural_frequency_hz = 4.5, .damping_ns_per_m = 0.06};
    job.cart.amplitude_m = 0.89e-3;
    job.contact = KelvinVoigt{.stiffness_n_per_m = 5.5e6, .damping_ns_per_m = 1.2e3};
    job.columns = {.from = 2, .to = 2, .points = 1};
    job.rows = {.from = 1, .to = 1, .points = 1};
    job.uncertainty.rigs = rigs;
    return job;
}

// Of a number over all draws.
struct Moments {
    double mean = 0;
    double variance = 0;
};
std::vector<double> values_of(const Job& job, std::string_view key) {
    const RigDraws draws(job);
    const CellNumbers own = numbers_at(job, 0, 0);
    std::vector<double> values;
    for (std::size_t n = 0; n < draws.count(); ++n) {
        CellNumbers rig = draws.rig(own, n);
        draws.place(rig, own, n);
        values.push_back(number_of(rig, key));
    }
    return values;
}
double covariance_of(const std::vector<double>& a, const std::vector<double>& b) {
    double of_a = 0;
    double of_b = 0;
    double product = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        of_a += a[i];
        of_b += b[i];
    }
    const auto count = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) product += (a[i] - of_a / count) * (b[i] - of_b / count);
    return product / count;
}
Moments moments_of(const Job& job, std::string_view key) {
    const std::vector<double> values = values_of(job, key);
    double sum = 0;
    for (const double value : values) sum += value;
    return {sum / static_cast<double>(values.size()), covariance_of(values, values)};
}

TEST(RigDraws, EachNumberHasItsSpreadAroundTheJobsOwn) {
    Job job = one_cell(1024);
    job.uncertainty.numbers["contact.stiffness_n_per_m"].relative = 0.03;
    job.uncertainty.numbers["hammer.mass_kg"].standard_deviation = 0.001;
    Spread& uniform = job.uncertainty.numbers["hammer.damping_ratio"];
    uniform.from = 0.003;
    uniform.to = 0.005;
    const Moments stiffness = moments_of(job, "contact.stiffness_n_per_m");
    EXPECT_NEAR(stiffness.mean, 5.5e6, 1e-5 * 5.5e6);
    EXPECT_NEAR(std::sqrt(stiffness.variance), 0.03 * 5.5e6, 0.002 * 0.03 * 5.5e6);
    const Moments mass = moments_of(job, "hammer.mass_kg");
    EXPECT_NEAR(mass.mean, 0.298, 1e-6);
    EXPECT_NEAR(std::sqrt(mass.variance), 0.001, 0.002 * 0.001);
    const Moments ratio = moments_of(job, "hammer.damping_ratio");
    EXPECT_NEAR(ratio.mean, 0.004, 1e-8);
    EXPECT_NEAR(ratio.variance, 0.002 * 0.002 / 12, 1e-4 * 0.002 * 0.002 / 12);
    for (const double value : values_of(job, "hammer.damping_ratio")) {
        EXPECT_GE(value, 0.003);
        EXPECT_LE(value, 0.005);
    }
    EXPECT_EQ(RigDraws(job).drawn_again(), 0);
}

TEST(RigDraws, NumbersOfACovarianceDeviateTogether) {
    Job job = one_cell(4096);
    const std::vector<std::string> keys{"contact.stiffness_n_per_m", "hammer.damping_ratio",
                                        "operating_point.gap_m"};
    const std::vector<double> sizes{2e5, 2e-4, 3e-5};
    const std::vector<std::vector<double>> correlation{{1, 0.8, -0.3}, {0.8, 1, 0.1}, {-0.3, 0.1, 1}};
    job.uncertainty.covariance.of = keys;
    job.uncertainty.covariance.mean = {5.4e6, 0.004, 0.001};  // not those of the job
    for (std::size_t i = 0; i < 3; ++i) {
        std::vector<double>& row = job.uncertainty.covariance.matrix.emplace_back();
        for (std::size_t j = 0; j < 3; ++j) row.push_back(correlation[i][j] * sizes[i] * sizes[j]);
    }
    std::vector<std::vector<double>> values;
    const CellNumbers own = numbers_at(job, 0, 0);
    for (const std::string& key : keys) {
        values.push_back(values_of(job, axis_key_of(key)));
        const double mean = moments_of(job, axis_key_of(key)).mean;
        EXPECT_NEAR(mean, number_of(own, axis_key_of(key)), 2e-3 * sizes[values.size() - 1]) << key;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(covariance_of(values[i], values[j]) / sizes[i] / sizes[j], correlation[i][j], 0.01);
    }
}

TEST(RigDraws, DrawsOutsideARangeAreDrawnAgainAndCounted) {
    Job job = one_cell(64);
    job.hammer.damping_ns_per_m.reset();
    job.hammer.damping_ratio = 0.004;
    job.uncertainty.numbers["hammer.damping_ratio"].relative = 1;  // negative in 16 % of the draws
    const RigDraws draws(job);
    EXPECT_EQ(draws.count(), 64U);
    EXPECT_GE(draws.drawn_again(), 8);
    EXPECT_LE(draws.drawn_again(), 18);
    EXPECT_EQ(draws.most_out_of_range(), "hammer.damping_ratio");
    for (const double ratio : values_of(job, "hammer.damping_ratio")) EXPECT_GE(ratio, 0);
    job.uncertainty.numbers["hammer.damping_ratio"] = {.standard_deviation = 10};  // in range: half of them
    EXPECT_EQ(RigDraws(job).count(), 64U);
}

TEST(RigDraws, FewInRangeAreTooFew) {
    Job job = one_cell(64);
    job.uncertainty.numbers["operating_point.frequency_hz"] = {.from = -1000, .to = 0};  // of 9 Hz
    EXPECT_LT(RigDraws(job).count(), 64U);
    EXPECT_EQ(RigDraws(job).most_out_of_range(), "frequency_hz");
}

// A draw that leaves a range in one cell is drawn again for all, so that all cells have the same draws.
TEST(RigDraws, AreTheSameInAllCells) {
    Job job = one_cell(64);
    job.hammer.damping_ns_per_m.reset();
    job.hammer.damping_ratio = 0.004;
    job.columns = {.from = 0.001, .to = 0.004, .points = 2, .over = "hammer.damping_ratio"};
    job.operating_point.frequency_ratio = 2;
    job.uncertainty.numbers["hammer.damping_ratio"].standard_deviation = 0.001;
    const RigDraws draws(job);
    EXPECT_GT(draws.drawn_again(), 0);
    for (std::size_t n = 0; n < draws.count(); ++n) {
        const double first = number_of(draws.rig(numbers_at(job, 0, 0), n), "hammer.damping_ratio");
        const double last = number_of(draws.rig(numbers_at(job, 0, 1), n), "hammer.damping_ratio");
        EXPECT_NEAR(last - first, 0.003, 1e-15);
        EXPECT_GE(first, 0);
    }
}

// The cart's speed, the gap and the start are set in Hz, m and m/s, whatever the rig turns out to be.
TEST(RigDraws, ThePlaceStaysInHertzAndMetres) {
    Job job = one_cell(32);
    job.start = {.displacement_ratio = -2, .velocity_ratio = 1.5};
    job.uncertainty.numbers["hammer.natural_frequency_hz"].relative = 0.1;
    job.uncertainty.numbers["cart.amplitude_m"].relative = 0.1;
    const RigDraws draws(job);
    const CellNumbers own = numbers_at(job, 0, 0);
    for (std::size_t n = 0; n < draws.count(); ++n) {
        CellNumbers rig = draws.rig(own, n);
        draws.place(rig, own, n);
        EXPECT_EQ(rig.place.frequency_hz, 9.0);
        EXPECT_EQ(rig.place.gap_m, 0.89e-3);
        EXPECT_NEAR(rig.frequency_ratio() * number_of(rig, "hammer.natural_frequency_hz"), 9.0, 1e-12);
        EXPECT_NEAR(rig.displacement_ratio() * rig.cart.amplitude_m, -2 * 0.89e-3, 1e-15);
        EXPECT_NEAR(rig.velocity_ratio() * unit_of("velocity_ratio", rig), 1.5 * unit_of("velocity_ratio", own),
                    1e-15);
    }
}

TEST(RigDraws, OffsetsAddToThePlaceInTheirUnit) {
    Job job = one_cell(256);
    job.uncertainty.numbers["operating_point.gap_ratio"].standard_deviation = 0.1;
    job.uncertainty.numbers["operating_point.frequency_hz"] = {.from = -0.5, .to = 0.5};
    EXPECT_FALSE(RigDraws(job).vary_the_rig());
    const Moments gap = moments_of(job, "gap_ratio");
    EXPECT_NEAR(gap.mean, 1, 1e-9);
    EXPECT_NEAR(std::sqrt(gap.variance), 0.1, 0.001);
    const Moments frequency = moments_of(job, "frequency_hz");
    EXPECT_NEAR(frequency.mean, 9, 1e-9);
    EXPECT_NEAR(frequency.variance, 1.0 / 12, 1e-4);
}

TEST(CholeskyFactor, IsThatOfAMatrixWithAnyUnits) {
    const auto factor = cholesky_factor({{4e12, 2e-3, 0}, {2e-3, 5e-18, 0}, {0, 0, 9}});
    ASSERT_TRUE(factor);
    EXPECT_DOUBLE_EQ((*factor)[0][0], 2e6);
    EXPECT_DOUBLE_EQ((*factor)[1][0], 1e-9);
    EXPECT_DOUBLE_EQ((*factor)[1][1], 2e-9);
    EXPECT_DOUBLE_EQ((*factor)[2][2], 3);
    EXPECT_FALSE(cholesky_factor({{1, 2}, {2, 1}}));
    EXPECT_FALSE(cholesky_factor({{1, 0}, {0, -1}}));
}

}  // namespace
}  // namespace peterka::job
