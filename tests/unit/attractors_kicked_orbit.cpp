// A kick in the middle of a cycle, for every engine.
#include "attractors/kicked_orbit.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "rig.hpp"

namespace peterka::attractors {
namespace {

using regime::Engine;
using regime::EngineSettings;

struct Case {
    const char* name;
    scene::Oscillator<double> oscillator;
    EngineSettings settings;
    double tolerance;  // an integrator's steps in parts of a cycle differ from those in a whole one
};

std::vector<Case> cases() {
    const scene::Oscillator<double> paper = testing::paper_rig(testing::beam_170mm, 2.0, 0.5);
    scene::Oscillator<double> rigid = paper;
    rigid.contact = scene::Restitution<double>{0.6};
    scene::Oscillator<double> cubic = paper;
    cubic.cubic = 0.02;
    scene::Oscillator<double> absolute = cubic;
    absolute.cubic_form = job::CubicForm::absolute;
    return {{"exact", paper, {}, 1e-9},
            {"rigid", rigid, {}, 1e-9},
            {"split", cubic, {Engine::split, 1e-8, 5}, 1e-5},
            {"absolute", absolute, {Engine::split, 1e-8, 5}, 1e-5},
            {"cvode", paper, {Engine::cvode, 1e-9, 5}, 1e-6},
            {"arkode", absolute, {Engine::arkode, 1e-9, 5}, 1e-6},
            {"rigid arkode", rigid, {Engine::arkode, 1e-9, 5}, 1e-6}};
}

// Kicks in flight, in contact and after an impact.
TEST(KickedOrbit, PartsOfACycleMakeTheWhole) {
    for (const Case& each : cases()) {
        regime::CycleMap map = regime::make_cycle_map(each.oscillator, each.settings);
        std::visit(
            [&](auto& engine) {
                const scene::State<double> start(-1.5, 1.0);
                const double period = each.oscillator.period();
                const scene::State<double> whole = engine(start).end;
                for (int n = 1; n < 64; ++n) {
                    const double moment = period * n / 64;
                    const auto first = engine.part(start, 0, moment);
                    const auto second = engine.part(first.end, moment, period);
                    EXPECT_LT((second.end - whole).norm(), each.tolerance * (1 + whole.norm()))
                        << each.name << " " << n;
                }
            },
            map);
    }
}

// A kick of size zero leads back to the orbit, from any phase of any of its cycles.
TEST(KickedOrbit, StaysOnTheOrbitWithoutAKick) {
    const scene::Oscillator<double> oscillator = testing::paper_rig(testing::beam_170mm, 2.75, 0.0);  // 2/2
    const regime::CellResult found = regime::find_steady_state(oscillator, testing::start_at(oscillator), {});
    ASSERT_EQ(found.period, 2);
    KickedOrbit orbit(oscillator, {0, {}, found});
    ASSERT_EQ(orbit.period(), 2);
    const auto second = orbit.after({0.37, 0});
    const auto first = orbit.after({1.62, 0});
    ASSERT_TRUE(first.done() && second.done());
    EXPECT_NEAR(first.state[0], found.orbit_displacement - oscillator.gap, 1e-9);
    EXPECT_NEAR(first.state[1], found.orbit_velocity, 1e-9);
    EXPECT_GT((first.state - second.state).norm(), 0.1);
    EXPECT_NEAR(orbit.after({0.0, 0.25}).state[1], found.orbit_velocity + 0.25, 1e-12);
    EXPECT_NEAR(orbit.after({2.0, -0.25}).state[1], found.orbit_velocity - 0.25, 1e-9);
}

}  // namespace
}  // namespace peterka::attractors
