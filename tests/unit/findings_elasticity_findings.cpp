// Medians of the elasticities of a map's orbits, label by label, in bins finer than the digits that are told.
#include "findings/elasticity_findings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "job_examples.hpp"

namespace peterka::findings {
namespace {

using quantities::StoredCell;
using regime::Regime;

std::int32_t row_of_quantity(std::string_view name) {
    std::int32_t row = 0;
    while (cell::quantities[static_cast<std::size_t>(row)].name != name) ++row;
    return row;
}

// By the stop's stiffness and damping, the tenth and eleventh number of cell::Elasticities.
StoredCell with_elasticities(std::int32_t impacts, std::int32_t period, double by_stiffness,
                             double by_damping) {
    StoredCell cell;
    cell.regime = Regime::periodic;
    cell.impacts = impacts;
    cell.period = period;
    cell.elasticities[9] = by_stiffness;
    cell.elasticities[10] = by_damping;
    return cell;
}

struct OfTwo {
    job::Job job = job::examples::map();
    ElasticityFindings findings;
    std::int32_t stiffness = row_of_quantity("force_elasticity_contact_stiffness_n_per_m");
    std::int32_t damping = row_of_quantity("force_elasticity_contact_damping_ns_per_m");

    OfTwo() {
        job.output.fields = {cell::OptionalField::force_by_contact_stiffness_n_per_m,
                             cell::OptionalField::force_by_contact_damping_ns_per_m};
    }
    void add(const std::vector<StoredCell>& cells) {
        add_elasticities(findings, job, {0, 0, 0, {1, std::ssize(cells)}}, cells);
    }
    [[nodiscard]] double median(std::int32_t period, std::int32_t impacts, std::int32_t quantity,
                                OfElasticities what = OfElasticities::value) const {
        return median_of(findings, period, impacts, quantity, what).value_or(cell::unknown);
    }
};

TEST(ElasticityFindings, MediansAreOfEachLabelAndNumber) {
    OfTwo of;
    of.add({with_elasticities(1, 1, 0.5, -0.1), with_elasticities(1, 1, 0.7, -0.2),
            with_elasticities(1, 1, 4, -0.3), with_elasticities(1, 2, 3, 2)});
    of.add({with_elasticities(1, 1, -9, -0.4), with_elasticities(1, 1, 0.6, -0.5)});
    EXPECT_NEAR(of.median(1, 1, of.stiffness), 0.6, 0.6e-3);
    EXPECT_NEAR(of.median(1, 1, of.damping), -0.3, 0.3e-3);
    EXPECT_NEAR(of.median(2, 1, of.stiffness), 3, 3e-3);
    EXPECT_NEAR(of.median(2, 1, of.damping), 2, 2e-3);
    EXPECT_TRUE(std::isnan(of.median(3, 1, of.stiffness)));
    EXPECT_TRUE(std::isnan(of.median(1, 1, of.stiffness, OfElasticities::share)));  // without [uncertainty]
}

TEST(ElasticityFindings, TheMedianOfAnEvenNumberIsBetweenTheMiddleTwo) {
    OfTwo of;
    of.add({with_elasticities(1, 1, 0.5, 1), with_elasticities(1, 1, 0.7, 1), with_elasticities(1, 1, 4, 2),
            with_elasticities(1, 1, -9, 2)});
    EXPECT_NEAR(of.median(1, 1, of.stiffness), 0.6, 0.6e-3);
    EXPECT_NEAR(of.median(1, 1, of.damping), 1.5, 1.5e-3);
}

TEST(ElasticityFindings, OtherMotionsAndCellsWithoutElasticitiesDoNotCount) {
    OfTwo of;
    StoredCell chaotic = with_elasticities(0, 0, 8, 8);
    chaotic.regime = Regime::chaotic;
    of.add({chaotic, with_elasticities(1, 1, cell::unknown, cell::unknown), with_elasticities(1, 1, 0.5, 0)});
    EXPECT_NEAR(of.median(1, 1, of.stiffness), 0.5, 0.5e-3);
    EXPECT_EQ(of.median(1, 1, of.damping), 0);
    EXPECT_EQ(of.findings.size(), 2U);
}

TEST(ElasticityFindings, SharesAndDeviationsAreApartFromTheValues) {
    OfTwo of;
    of.job.uncertainty.rigs = 16;
    of.job.uncertainty.numbers["contact.stiffness_n_per_m"].relative = 0.06;
    of.job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.02;
    of.add({with_elasticities(1, 1, 0.5, -2)});
    EXPECT_NEAR(of.median(1, 1, of.stiffness), 0.5, 0.5e-3);
    EXPECT_NEAR(of.median(1, 1, of.stiffness, OfElasticities::share), 0.36, 0.4e-3);
    EXPECT_NEAR(of.median(1, 1, of.damping, OfElasticities::share), 0.64, 0.7e-3);
    EXPECT_NEAR(of.median(1, 1, of.damping, OfElasticities::deviation), 0.05, 0.05e-3);
}

}  // namespace
}  // namespace peterka::findings
