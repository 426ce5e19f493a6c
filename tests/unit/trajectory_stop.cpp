// A long cycle is interrupted when a stop is requested: every engine checks the request.
#include <gtest/gtest.h>

#include <csignal>

#include "integrators/integrated_cycle_map.hpp"
#include "rig.hpp"
#include "scene/in_precision.hpp"
#include "study/rk4_cycle_map.hpp"
#include "study/taylor_cycle_map.hpp"
#include "support/stop_request.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;
using study::Rk4CycleMap;
using study::Rk4Events;
using study::TaylorCycleMap;

scene::Oscillator<double> bouncing() {
    auto oscillator = testing::paper_rig(testing::beam_170mm, 0.05, -0.5);
    oscillator.contact = scene::KelvinVoigt<double>{1e4, 0};  // preloaded, without any dissipation
    return oscillator;
}

scene::Oscillator<double> hopping() {
    auto oscillator = testing::paper_rig(testing::beam_170mm, 0.05, -0.5);
    oscillator.contact = scene::Restitution<double>{0.99};
    return oscillator;
}

template <class Map>
void expect_to_stop(Map&& map, const State<double>& x) {
    EXPECT_NO_THROW(static_cast<void>(map(x))) << "nobody asks";
    {
        const StopRequest nobody;
        EXPECT_NO_THROW(static_cast<void>(map(x)));
    }
    const StopRequest stop;
    std::raise(SIGUSR1);
    EXPECT_THROW(static_cast<void>(map(x)), Stopped);
}

TEST(StopWithinACycle, OfTheClosedForm) {
    expect_to_stop(ExactCycleMap<double>(bouncing()), {-0.5, 1});
    expect_to_stop(RigidExactMap<double>(hopping()), {-0.5, 1});
}

TEST(StopWithinACycle, OfTheSplitMap) {
    auto oscillator = testing::paper_rig(testing::beam_170mm, 2.0, 0.0);
    oscillator.cubic = 1e-3;
    expect_to_stop(SplitCycleMap<double>(oscillator, 64), {-0.5, 1});
}

TEST(StopWithinACycle, OfTheIntegrators) {
    const auto oscillator = testing::paper_rig(testing::beam_170mm, 0.5, 0.0);
    for (const auto integrator : {Integrator::cvode_adams, Integrator::cvode_bdf, Integrator::arkode_explicit,
                                  Integrator::arkode_implicit}) {
        IntegratedCycleMap map(oscillator, integrator, 1e-9);
        expect_to_stop([&](const State<double>& x) { return map(x); }, {-0.5, 1});
    }
}

TEST(StopWithinACycle, OfTheStudysMethods) {
    const auto oscillator = testing::paper_rig(testing::beam_170mm, 2.0, 0.0);
    expect_to_stop(
        [&](const State<double>& x) { return Rk4CycleMap(oscillator, 500, Rk4Events::located)(x, false); },
        {-0.5, 1});
    for (const auto& each : {bouncing(), hopping()}) {
        const TaylorCycleMap map(scene::in_precision<long double>(each));
        expect_to_stop([&](const State<double>& x) { return map(x.cast<long double>()); }, {-0.5, 1});
    }
}

}  // namespace
}  // namespace peterka::trajectory
