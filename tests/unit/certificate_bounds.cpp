// Bounds on which proofs rest, against samples of what they bound: none lies beyond, the worst comes near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "certificate/reach.hpp"

namespace peterka::certificate {
namespace {

// r = gamma u^3 or gamma (x^3 - y^3) with x = u + y, and its first two derivatives, from those of u and of y =
// sin(theta).
Drive cubic_term(double gamma, bool absolute, const Drive& u, const Drive& y) {
    const auto cube = [](const Drive& x) {
        return Drive{x.value * x.value * x.value, 3 * x.value * x.value * x.rate,
                     3 * x.value * (2 * x.rate * x.rate + x.value * x.bend)};
    };
    if (!absolute) {
        const Drive r = cube(u);
        return {gamma * r.value, gamma * r.rate, gamma * r.bend};
    }
    const Drive of_hammer = cube({u.value + y.value, u.rate + y.rate, u.bend + y.bend});
    const Drive of_cart = cube(y);
    return {gamma * (of_hammer.value - of_cart.value), gamma * (of_hammer.rate - of_cart.rate),
            gamma * (of_hammer.bend - of_cart.bend)};
}

TEST(CertificateBounds, OfTheCubicTermHold) {
    std::mt19937_64 random(4);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int rigs = 0; rigs < 40; ++rigs) {
        const bool absolute = rigs % 2 == 1;
        const RigOf<double> rig{.damping_ratio = 0.02,
                                .frequency = between(0.3, 5),
                                .period = 1,
                                .cubic = between(-0.2, 0.2),
                                .absolute = absolute};
        const Phase<double> phase(rig, false);
        const double u = between(0.1, 4);
        const double v = between(0.1, 4);
        const double a = between(0.1, 9);
        const Drive bound = cubic_drive(phase, u, v, a);
        Drive worst;
        double steepest = 0;
        for (int samples = 0; samples < 4000; ++samples) {
            const auto part = [&] {
                return samples % 2 == 0 ? between(-1, 1) : std::copysign(1.0, between(-1, 1));
            };
            const double theta = samples % 3 == 0 ? std::copysign(std::acos(0.0), part()) : between(-4, 4);
            const double eta = rig.frequency;
            const Drive cart{std::sin(theta), eta * std::cos(theta), -eta * eta * std::sin(theta)};
            const Drive hammer{u * part(), v * part(), a * part()};
            const Drive r = cubic_term(rig.cubic, absolute, hammer, cart);
            worst = {std::max(worst.value, std::abs(r.value)), std::max(worst.rate, std::abs(r.rate)),
                     std::max(worst.bend, std::abs(r.bend))};
            const double x = hammer.value + (absolute ? cart.value : 0);
            steepest = std::max(steepest, std::abs(3 * rig.cubic * x * x));
        }
        EXPECT_LE(worst.value, bound.value);
        EXPECT_LE(worst.rate, bound.rate * (1 + 1e-12));
        EXPECT_LE(worst.bend, bound.bend * (1 + 1e-12));
        EXPECT_LE(steepest, phase.largest_cubic_slope(u));
        EXPECT_GT(steepest, 0.999 * phase.largest_cubic_slope(u));
        // The cart's own cube, at most gamma, is added to that of the hammer, not subtracted.
        EXPECT_GT(worst.value + (absolute ? 2 * std::abs(rig.cubic) : 0), 0.999 * bound.value);
        if (!absolute) {
            EXPECT_GT(worst.rate, 0.999 * bound.rate);
            EXPECT_GT(worst.bend, 0.999 * bound.bend);
        }
    }
}

// The acceleration of a hammer at rest on the stop, eta^2 s - g - gamma ((g + s)^3 - s^3), rises with s =
// sin(theta).
TEST(CertificateBounds, PressingRisesWhereItsSlopeSaysSo) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(-1, 1);
    int rising = 0;
    int falling = 0;
    for (int rigs = 0; rigs < 400; ++rigs) {
        const RigOf<double> rig{.frequency = 1 + share(random),
                                .gap = 3 * share(random),
                                .period = 1,
                                .cubic = 0.3 * share(random),
                                .absolute = true};
        const RigOf<Interval> enclosed{.frequency = Interval(rig.frequency),
                                       .gap = Interval(rig.gap),
                                       .period = Interval(1),
                                       .cubic = Interval(rig.cubic),
                                       .absolute = true};
        double least = 1e9;
        for (const double s : {-1.0, 1.0}) {  // the slope is linear in s
            least = std::min(
                least, rig.frequency * rig.frequency - 3 * rig.cubic * ((rig.gap + s) * (rig.gap + s) - s * s));
        }
        if (std::abs(least) < 1e-9) continue;
        EXPECT_EQ(Phase<Interval>(enclosed, false).pressing_rises(), least > 0);
        (least > 0 ? rising : falling) += 1;
    }
    EXPECT_GT(rising, 100);
    EXPECT_GT(falling, 30);
}

}  // namespace
}  // namespace peterka::certificate
