// The lemma on chatter against bounces that are followed one by one: no speed exceeds its bound, all that it
// proves to rest do, and it proves nearly as much as there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "certificate/chatter.hpp"

namespace peterka::certificate {
namespace {

template <class Number>
RigOf<Number> enclosing(const RigOf<double>& rig) {
    return {.damping_ratio = Number(rig.damping_ratio),
            .frequency = Number(rig.frequency),
            .gap = Number(rig.gap),
            .period = Number(2) * Number(std::acos(-1.0)) / Number(rig.frequency),
            .cubic = Number(rig.cubic),
            .absolute = rig.absolute,
            .rigid = true,
            .restitution = Number(rig.restitution)};
}

struct Bounces {
    double fastest = 0;  // impact after the first flight [A0 omega]
    bool rest = false;   // before the lift-off
};

// A flight from the stop by classical Runge-Kutta steps, 400 of them for the shortest parabola that it may be.
class Bouncing {
  public:
    explicit Bouncing(const RigOf<double>& rig) : phase_(rig, false), restitution_(rig.restitution) {}

    [[nodiscard]] double pressing(double time) const {
        return phase_.acceleration({0, 0}, std::sin(phase_.frequency() * time));
    }

    // Leaves the stop with this speed at this time.
    [[nodiscard]] Bounces follow(double time, double speed, double lift_off) const {
        Bounces bounces;
        const double first = speed;
        while (time < lift_off) {
            if (speed <= 1e-7 * first) return {bounces.fastest, true};
            const std::optional<Vector<double>> end = fly(time, speed, lift_off);
            if (!end) return bounces;
            bounces.fastest = std::max(bounces.fastest, end->velocity);
            speed = restitution_ * end->velocity;
        }
        return bounces;
    }

  private:
    // The state at the next impact, and its time in `time`; nothing after the lift-off.
    [[nodiscard]] std::optional<Vector<double>> fly(double& time, double speed, double lift_off) const {
        Vector<double> state{0, -speed};
        while (time < lift_off) {
            const double step = std::min(2 * speed / pressing(time), 0.05) / 400;
            const Vector<double> next = stepped(state, time, step);
            if (next.position >= 0 && next.velocity > 0) {
                double part = step;
                for (int corrections = 0; corrections < 3; ++corrections) {
                    const Vector<double> at = stepped(state, time, part);
                    part -= at.position / at.velocity;
                }
                time += part;
                return stepped(state, time - part, part);
            }
            state = next;
            time += step;
        }
        return std::nullopt;
    }
    [[nodiscard]] Vector<double> stepped(const Vector<double>& state, double time, double step) const {
        const auto rate = [&](const Vector<double>& at, double later) {
            return Vector<double>{at.velocity,
                                  phase_.acceleration(at, std::sin(phase_.frequency() * (time + later)))};
        };
        const auto along = [](const Vector<double>& at, const Vector<double>& slope, double length) {
            return Vector<double>{at.position + length * slope.position, at.velocity + length * slope.velocity};
        };
        const auto k1 = rate(state, 0);
        const auto k2 = rate(along(state, k1, step / 2), step / 2);
        const auto k3 = rate(along(state, k2, step / 2), step / 2);
        const auto k4 = rate(along(state, k3, step), step);
        return {state.position + step / 6 * (k1.position + 2 * k2.position + 2 * k3.position + k4.position),
                state.velocity + step / 6 * (k1.velocity + 2 * k2.velocity + 2 * k3.velocity + k4.velocity)};
    }

    Phase<double> phase_;
    double restitution_;
};

// The speed up to which a condition holds, to a part in a thousand; it holds for 1e-6 and does not for 100.
template <class Condition>
double largest_speed(const Condition& holds) {
    double low = 1e-6;
    double high = 100;
    while (high / low > 1.001) {
        const double middle = std::sqrt(low * high);
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

TEST(ChatterLemma, WhatItProvesToRestDoesAndIsNoFasterThanItsBound) {
    std::mt19937_64 random(8);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int rigs = 0;
    double nearest_rest = 0;
    double nearest_speed = 0;
    for (int draws = 0; draws < 400 && rigs < 60; ++draws) {
        const RigOf<double> rig{.damping_ratio = draws % 3 == 0 ? 0 : between(0, 0.3),
                                .frequency = between(0.3, 4),
                                .gap = between(-1, 1),
                                .period = 1,
                                .cubic = draws % 2 == 0 ? 0 : between(-0.1, 0.2),
                                .absolute = draws % 4 == 1,
                                .rigid = true,
                                .restitution = between(0.05, 0.9)};
        Springs<Interval> springs(enclosing<Interval>(rig));
        const Bouncing bouncing(rig);
        if (!find_lift_off(springs)) continue;
        // A shorter time than that to the lift-off: while a hardly changes, the bounds are sharp.
        const double stretch = between(0.05, 0.4) * springs.rig.period.middle();
        const double before = springs.lift_off.middle() - stretch;
        const double lift_off = before + stretch * std::pow(10, between(-3, 0));
        springs.lift_off = Interval(lift_off);
        if (bouncing.pressing(before) < 0.02) continue;
        const auto bound = [&](double impact) {
            const EventChain chain{1, {{EventKind::bounce, 1, before, impact}}};
            return comes_to_rest(springs, chain, {{Interval(before), Interval(impact)}});
        };
        const auto rests = [&](double impact) {
            return bouncing.follow(before, rig.restitution * impact, lift_off).rest;
        };
        if (!bound(1e-6) || !rests(1e-6)) continue;
        ++rigs;
        const double proved = largest_speed([&](double impact) { return bound(impact).has_value(); });
        const double true_one = largest_speed(rests);
        EXPECT_LE(proved, 1.002 * true_one) << draws;
        nearest_rest = std::max(nearest_rest, proved / true_one);
        for (const double part : {1e-3, 0.1, 0.9, 1.0}) {
            const double impact = 1e-6 + part * (proved - 1e-6);
            const auto speed = bound(impact);
            if (!speed) continue;
            const double fastest = bouncing.follow(before, rig.restitution * impact, lift_off).fastest;
            EXPECT_LE(fastest, *speed * (1 + 1e-6)) << draws;
            nearest_speed = std::max(nearest_speed, fastest / *speed);
        }
    }
    EXPECT_GE(rigs, 50);
    EXPECT_GT(nearest_rest, 0.94);
    EXPECT_GT(nearest_speed, 0.99);
}

// The hammer is on the side of delta < 0.
TEST(ChatterLemma, TheAccelerationNearTheStopLiesWithinItsBoundsAndComesNear) {
    std::mt19937_64 random(9);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int rigs = 0; rigs < 60; ++rigs) {
        const RigOf<double> rig{.damping_ratio = between(0, 0.5),
                                .frequency = between(0.3, 4),
                                .gap = between(-2, 2),
                                .period = 1,
                                .cubic = rigs % 2 == 0 ? 0 : between(-1, 1),
                                .absolute = rigs % 4 == 1,
                                .rigid = true,
                                .restitution = 0.5};
        const Phase<double> phase(rig, false);
        const double speed = between(0, 2);
        const double depth = between(0, 0.5);
        const double sine = between(-1, 1);
        const double at_rest = phase.acceleration({0, 0}, sine);
        const Interval bounds = acceleration_near_stop(Phase<Interval>(enclosing<Interval>(rig), false),
                                                       Interval(at_rest), Interval(speed), Interval(depth));
        double least = at_rest;
        double most = at_rest;
        for (int samples = 0; samples < 2000; ++samples) {
            const double part = samples % 2 == 0 ? 1 : between(0, 1);
            const double sign = samples % 4 < 2 ? 1 : -1;
            const double now = phase.acceleration({-part * depth, sign * speed}, sine);
            least = std::min(least, now);
            most = std::max(most, now);
        }
        EXPECT_GE(least, bounds.lo - 1e-12);
        EXPECT_LE(most, bounds.hi + 1e-12);
        // Only the pull of the linear spring, and in half of the cases the cubic one, has a known sign.
        if (rig.cubic == 0) {
            EXPECT_NEAR(most, bounds.hi, 1e-12);
            EXPECT_NEAR(at_rest - 2 * rig.damping_ratio * speed, bounds.lo, 1e-12);
        }
    }
}

// After an impact outside the last stretch of pressing nothing is proved, with r = 0 neither.
TEST(ChatterLemma, AnImpactThatIsNotFollowedByRestUntilTheLiftOffProvesNothing) {
    for (const double restitution : {0.0, 0.5}) {
        const RigOf<double> rig{.damping_ratio = 0.01,
                                .frequency = 2,
                                .gap = 0.5,
                                .period = 1,
                                .rigid = true,
                                .restitution = restitution};
        Springs<Interval> springs(enclosing<Interval>(rig));
        ASSERT_TRUE(find_lift_off(springs));
        const double lift_off = springs.lift_off.middle();
        const auto proves = [&](std::int64_t cycle, double time) {
            const EventChain chain{1, {{EventKind::bounce, cycle, time, 1e-3}}};
            return comes_to_rest(springs, chain, {{Interval(time), Interval(1e-3)}}).has_value();
        };
        EXPECT_TRUE(proves(1, lift_off - 0.3));
        EXPECT_FALSE(proves(0, lift_off - 0.3));  // a whole cycle earlier: it lifts off in between
        EXPECT_FALSE(proves(1, lift_off + 0.3));
        EXPECT_FALSE(proves(1, lift_off - 0.5 * springs.rig.period.middle() - 0.3));  // not pressed there
    }
}

}  // namespace
}  // namespace peterka::certificate
