// Permanent contacts.
#include "trajectory/lasting_contact.hpp"

#include <gtest/gtest.h>

namespace peterka::trajectory {
namespace {

TEST(LinearContact, DecaysUnlessNeitherSpringsNorStopAreDamped) {
    const auto decays = [](double of_springs, double of_stop) {
        return LinearContact<double>({.damping_ratio = of_springs,
                                      .contact = scene::KelvinVoigt<double>{100, of_stop},
                                      .frequency = 2,
                                      .gap = -3})
            .decays();
    };
    EXPECT_FALSE(decays(0, 0));
    EXPECT_TRUE(decays(0.01, 0));
    EXPECT_TRUE(decays(0, 0.5));
}

}  // namespace
}  // namespace peterka::trajectory
