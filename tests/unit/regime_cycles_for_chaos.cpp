// An oscillator's dissipation per cycle, against the Jacobians of its engine along chaos.
#include "regime/cycles_for_chaos.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::regime {
namespace {

struct Measured {
    double loss = 0;
    double impacts = 0;  // per cycle
};

template <class Map>
Measured along_chaos(const scene::Oscillator<double>& oscillator) {
    constexpr int cycles = 2000;
    const Map map(oscillator);
    scene::State<double> x = testing::start_at(oscillator);
    Measured sum;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const auto passed = map(x);
        sum.loss -= std::log(std::abs(passed.jacobian.determinant())) / cycles;
        sum.impacts += static_cast<double>(passed.impacts) / cycles;
        x = passed.end;
    }
    return sum;
}

TEST(CyclesForChaos, TheLossOfACycleIsThatOfItsJacobians) {
    for (const double damping : {60.0, 300.0, 1200.0}) {
        auto rig = testing::paper_rig(testing::beam_170mm, 3.3, 0.2);
        rig.contact = scene::KelvinVoigt<double>{rig.kelvin_voigt().stiffness,
                                                 rig.kelvin_voigt().damping * damping / 1200};
        const Measured found = along_chaos<trajectory::ExactCycleMap<double>>(rig);
        ASSERT_GT(found.impacts, 0.1);
        EXPECT_NEAR(loss_of_a_cycle(rig, found.impacts) / found.loss, 1, 0.05) << damping;
    }
    auto rigid = testing::paper_rig(testing::beam_170mm, 3.3, 0.2);
    rigid.contact = scene::Restitution<double>{0.9};
    const Measured found = along_chaos<trajectory::RigidExactMap<double>>(rigid);
    EXPECT_NEAR(loss_of_a_cycle(rigid, found.impacts) / found.loss, 1, 0.05);
}

TEST(CyclesForChaos, ALossyRigAsksForNoMoreThanItsJobDoes) {
    auto rig = testing::paper_rig(testing::beam_170mm, 3.3, 0.2);
    rig.damping_ratio = 0.9;
    EXPECT_LE(cycles_for_chaos(rig, {}, 1), 1100);
    rig.damping_ratio = 0.002;
    rig.contact = scene::Restitution<double>{0.98};
    EXPECT_GT(cycles_for_chaos(rig, {}, 0.5), 30000);
    EXPECT_GT(cycles_for_chaos(rig, {}, 0.1), cycles_for_chaos(rig, {}, 0.5));
}

}  // namespace
}  // namespace peterka::regime
