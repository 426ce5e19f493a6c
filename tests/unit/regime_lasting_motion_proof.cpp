// Motions valid for all future time: bounds on a trajectory's distance from the free orbit with a cubic spring.
#include "regime/lasting_motion_proof.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rig.hpp"

namespace peterka::regime {
namespace {

// By the midpoint rule on the closed form of the impulse response of u'' + 2 zeta u' + u.
double integral_of_impulse_response(double zeta) {
    const double w = std::sqrt(std::abs(1 - zeta * zeta));
    const double slowest = zeta < 1 ? zeta : zeta - w;
    const double step = 1e-3;
    double sum = 0;
    for (double t = step / 2; t < 40 / slowest; t += step) {
        const double swing = zeta < 1 ? std::sin(w * t) : std::sinh(w * t);
        sum += step * std::abs(std::exp(-zeta * t) * swing / w);
    }
    return sum;
}

TEST(LastingMotionProof, GainIsTheIntegralOfTheImpulseResponse) {
    for (const double zeta : {0.02, 0.1, 0.4, 0.9, 1.3}) {
        EXPECT_NEAR(gain(zeta) / integral_of_impulse_response(zeta), 1, 1e-4) << zeta;
    }
}

struct FreeHammer {
    scene::Oscillator<double> oscillator;
    CycleBroker broker;
    StroboscopicMap map;
    LastingMotionProof settling;
    SettledMotion motion;  // of a hammer that never touches the stop

    explicit FreeHammer(const scene::Oscillator<double>& with_cubic)
        : oscillator(with_cubic),
          map(oscillator, {Engine::arkode, 1e-9}, broker),
          settling(map),
          motion(settled()) {}

    // Near the stop's far side, where the linear amplitude of the distance equals its value at phase 0.
    [[nodiscard]] bool stays_free_at(double distance) {
        return stays_free_from(motion.point + scene::State<double>(distance, 0));
    }
    // By a proof of its own, which may not have looked for the orbit before.
    [[nodiscard]] bool stays_free_from(const scene::State<double>& x) const {
        return LastingMotionProof(map).stays_free(x).has_value();
    }

  private:
    // From the orbit of the linear springs, of a hammer whose stop is out of reach.
    [[nodiscard]] SettledMotion settled() {
        auto linear = oscillator;
        linear.cubic = 0;
        scene::State<double> start = trajectory::FreeFlight<double>(linear).steady();
        auto far = oscillator;
        far.gap += 100;
        const scene::State<double> away(far.gap - oscillator.gap, 0);
        StroboscopicMap free_map(far, map.settings(), broker);
        start -= away;
        const auto orbit = complete(find_orbit(free_map, free_map.scaled(start), 1), broker);
        if (!orbit) throw std::runtime_error("no free orbit");
        const auto found = settling.stays_free(free_map.unscaled(orbit->point()) + away);
        if (!found) throw std::runtime_error("the free orbit is not found");
        return *found;
    }
};

scene::Oscillator<double> damped_hammer(double cubic, job::CubicForm form) {
    auto oscillator = testing::paper_rig(testing::beam_170mm, 2, 3);
    oscillator.damping_ratio = 0.1;
    oscillator.cubic = cubic;
    oscillator.cubic_form = form;
    return oscillator;
}

// Distances grow to at most 1/(1 - L H) of their linear amplitude: the proof ends there, not at the stop.
TEST(LastingMotionProof, ACubicSpringTakesItsShareOfTheRoom) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        FreeHammer hammer(damped_hammer(1e-3, form));
        const double gap = hammer.oscillator.gap;
        const double farthest = form == job::CubicForm::absolute ? gap + 1 : gap;
        const double loop = 3e-3 * farthest * farthest * integral_of_impulse_response(0.1);
        ASSERT_GT(loop, 0.1);
        ASSERT_LT(loop, 0.5);
        const double rate =
            std::sqrt(1 - 0.1 * 0.1);  // an amplitude is a displacement at rest in the decay over this
        const double most = rate * (gap - hammer.motion.largest_displacement) * (1 - loop);
        EXPECT_TRUE(hammer.stays_free_at(-0.99 * most));
        EXPECT_FALSE(hammer.stays_free_at(-1.01 * most));
        EXPECT_TRUE(hammer.stays_free_at(0.99 * most));
        EXPECT_FALSE(hammer.stays_free_at(1.01 * most));
    }
}

struct NearAFreeOrbit {
    double frequency;
    double damping_ratio;
    double gap;
    double loop;  // L H; below 0: of a softening spring
};

// The orbit is looked for once a state is near the steady motion of the linear springs: that must leave out
// none that is close enough, in any direction, even where little room is left, and in resonance, where the
// orbit is farthest from the steady motion.
TEST(LastingMotionProof, EveryStateCloseEnoughIsFound) {
    constexpr NearAFreeOrbit cases[] = {{2, 0.0036, 1.4, 0.03}, {2, 0.0036, 3, 0.03}, {2, 0.1, 1.4, 0.03},
                                        {2, 0.1, 3, 0.03},      {2, 0.6, 1.4, 0.03},  {2, 0.6, 3, 0.03},
                                        {1, 0.1, 5.3, 0.3},     {1, 0.1, 5.3, -0.3},  {0.9, 0.1, 5, -0.3}};
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        for (const NearAFreeOrbit& each : cases) {
            auto oscillator = damped_hammer(0, form);
            oscillator.frequency = each.frequency;
            oscillator.damping_ratio = each.damping_ratio;
            oscillator.gap = each.gap;
            const double reach = form == job::CubicForm::absolute ? each.gap + 1 : each.gap;
            oscillator.cubic =
                each.loop / (3 * reach * reach * integral_of_impulse_response(each.damping_ratio));
            FreeHammer hammer(oscillator);
            const double zeta = each.damping_ratio;
            const double rate = std::sqrt(1 - zeta * zeta);
            const double most = (each.gap - hammer.motion.largest_displacement) * (1 - std::abs(each.loop));
            ASSERT_GT(most, 0);
            for (int n = 0; n < 16; ++n) {
                const double angle = 2 * std::numbers::pi * n / 16;
                const scene::State<double> e(std::cos(angle), rate * std::sin(angle) - zeta * std::cos(angle));
                EXPECT_TRUE(hammer.stays_free_from(hammer.motion.point + 0.999 * most * e));
                EXPECT_FALSE(hammer.stays_free_from(hammer.motion.point + 1.001 * most * e));
            }
        }
    }
}

TEST(LastingMotionProof, WhereNoFreeOrbitIsFoundOneMayExist) {
    const auto oscillator = damped_hammer(-10, job::CubicForm::relative);  // its springs throw it out
    CycleBroker broker;
    const StroboscopicMap map(oscillator, {Engine::arkode, 1e-9}, broker);
    EXPECT_TRUE(LastingMotionProof(map).may_settle());
}

TEST(LastingMotionProof, ACubicSpringThatIsTooStrongProvesNothing) {
    auto oscillator = damped_hammer(1e-3, job::CubicForm::relative);
    oscillator.cubic = 6.5e-3;  // L H = 1.1
    CycleBroker broker;
    const StroboscopicMap map(oscillator, {Engine::arkode, 1e-9}, broker);
    LastingMotionProof settling(map);
    EXPECT_TRUE(settling.may_settle());
    oscillator.cubic = 0;
    EXPECT_FALSE(settling.stays_free(trajectory::FreeFlight<double>(oscillator).steady()).has_value());
}

}  // namespace
}  // namespace peterka::regime
