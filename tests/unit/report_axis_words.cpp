// Places in words: enough digits that neighbouring points of an axis, and places half-way, are told apart.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "job/axis.hpp"
#include "job/axis_key.hpp"
#include "report/axis_words.hpp"

namespace peterka {
namespace {

std::set<std::string> told(const job::Axis& axis, int digits) {
    job::Job job;
    job.kind = job::Kind::sweep;
    job.hammer = {.mass_kg = 1.0, .natural_frequency_hz = 4.5, .damping_ratio = 0.01};
    job.cart.amplitude_m = 0.89e-3;
    job.columns = axis;
    const scene::Scene scene(job);
    std::set<std::string> texts;
    const auto values = job::axis_values(axis);
    for (std::size_t i = 0; i < values.size(); ++i) {
        texts.insert(value_in_words(scene, job::column_key(job), values[i], digits));
        if (i > 0)
            texts.insert(value_in_words(scene, job::column_key(job), (values[i - 1] + values[i]) / 2, digits));
    }
    return texts;
}

TEST(DigitsApart, NeighboursAndPlacesHalfWayHaveTextsOfTheirOwn) {
    for (const job::Axis& axis :
         {job::Axis{0.5, 4.5, 401, job::Spacing::linear}, job::Axis{2.49, 2.51, 301, job::Spacing::linear},
          job::Axis{0.01, 9.99, 5001, job::Spacing::log},
          job::Axis{9.9999, 10.0001, 11, job::Spacing::linear}}) {
        const auto distinct = static_cast<std::size_t>(2 * axis.points - 1);
        const int digits = digits_apart(axis);
        EXPECT_EQ(told(axis, digits).size(), distinct) << axis.from << " to " << axis.to << ", " << digits;
        EXPECT_LT(told(axis, digits - 2).size(), distinct) << axis.from << " to " << axis.to;
    }
}

TEST(DigitsApart, FourAreEnoughForCoarseAxesAndASinglePoint) {
    EXPECT_EQ(digits_apart({0.5, 4.5, 9, job::Spacing::linear}), 4);
    EXPECT_EQ(digits_apart({1.5, 1.5, 1, job::Spacing::linear}), 4);
    EXPECT_EQ(digits_apart({0.0, 0.0, 1, job::Spacing::linear}), 4);
}

TEST(AxisWords, LabelsSayWhichUnitFollows) {
    EXPECT_EQ(label_in_words("frequency_hz"), "frequency");
    EXPECT_EQ(label_in_words("gap_ratio"), "gap/A0");
    EXPECT_EQ(label_in_words("displacement_m"), "x");
    EXPECT_EQ(label_in_words("displacement_ratio"), "x/A0");
    EXPECT_EQ(label_in_words("velocity_m_per_s"), "x'");
    EXPECT_EQ(label_in_words("velocity_ratio"), "x'/(A0 omega)");
    EXPECT_EQ(label_in_words("contact.damping_ns_per_m"), "contact.damping_ns_per_m");
}

}  // namespace
}  // namespace peterka
