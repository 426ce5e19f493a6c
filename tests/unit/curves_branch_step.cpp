// Steps along the curve on which the motion without impact ends.
#include "curves/branch_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "curves/free_motion.hpp"
#include "curves/trace_curve.hpp"
#include "rig.hpp"

namespace peterka::curves {
namespace {

class Step : public ::testing::Test {
  protected:
    Rig rig_{testing::paper_rig(testing::beam_170mm, 1, 0)};
    PlanePoint window_{4, 5};
    Seed seed_ = *end_of_free_motion(rig_, {3.0, 0.0}, {3.0, 5.0}, window_);
    Stepper stepper_{rig_, window_, conditions_of(seed_.kind)};

    // At the seed, as if the curve had another direction there.
    [[nodiscard]] Stepper::Here turned_by(double angle) const {
        Stepper::Here here = stepper_.at(seed_.point);
        const Eigen::VectorXd tangent = here.tangent;
        Eigen::VectorXd across = Eigen::VectorXd::Unit(tangent.size(), tangent.size() - 1);
        across = (across - across.dot(tangent) * tangent).eval().normalized();
        here.tangent = std::cos(angle) * tangent + std::sin(angle) * across;
        return here;
    }
};

TEST_F(Step, ThatTurnsTooFarIsTakenOnlyIfAmongTheShortest) {
    for (const double step : {1e-3, 16.5e-8, 16.01e-8}) {
        stepper_.set_step(step);
        EXPECT_TRUE(stepper_.next(turned_by(0.6), 1));
        EXPECT_LE(stepper_.step(), 16e-8);
        EXPECT_GT(stepper_.step(), 8e-8);
    }
}

TEST_F(Step, ThatTurnsLittleLengthensTheNext) {
    stepper_.set_step(1e-4);
    EXPECT_TRUE(stepper_.next(turned_by(0), 1));
    EXPECT_GT(stepper_.step(), 1e-4);
    stepper_.set_step(1e-4);
    EXPECT_TRUE(stepper_.next(turned_by(0.2), 1));
    EXPECT_EQ(stepper_.step(), 1e-4);
}

}  // namespace
}  // namespace peterka::curves
