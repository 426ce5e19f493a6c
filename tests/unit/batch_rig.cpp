// What a rig tells of its contacts, against contacts followed by steps of Runge and Kutta.
#include "batch/rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace peterka::batch {
namespace {

struct Contact {
    double time;
    double force;
    double slope;
};

// A contact after a unit speed under a constant acceleration a: x'' + 2 b x' + w2 x = a, F = kappa x + chi x'.
// When the force is largest (0 if it falls from the beginning), and when it vanishes.
struct Ends {
    double peak = 0;
    double exit = 0;
};
Ends followed(const Rig& rig, double a) {
    const double step = rig.exit_time / 20000;
    double x = 0;
    double v = 1;
    const auto rate = [&](double position, double velocity) {
        return a - 2 * rig.contact_decay * velocity - rig.contact_square * position;
    };
    const auto contact = [&](double time) {
        const double acceleration = rate(x, v);
        return Contact{time, rig.stiffness * x + rig.damping * v,
                       rig.stiffness * v + rig.damping * acceleration};
    };
    Ends ends;
    Contact before = contact(0);
    for (int n = 1; ends.exit == 0 && n < 60000; ++n) {
        const double a1 = rate(x, v);
        const double a2 = rate(x + step / 2 * v, v + step / 2 * a1);
        const double a3 = rate(x + step / 2 * (v + step / 2 * a1), v + step / 2 * a2);
        const double a4 = rate(x + step * (v + step / 2 * a2), v + step * a3);
        x += step * (v + step / 6 * (a1 + a2 + a3));
        v += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        const Contact now = contact(n * step);
        const auto zero = [&](double from, double to) { return before.time + step * from / (from - to); };
        if (before.slope > 0 && now.slope <= 0) ends.peak = zero(before.slope, now.slope);
        if (before.force > 0 && now.force <= 0) ends.exit = zero(before.force, now.force);
        before = now;
    }
    return ends;
}

double at(std::span<const double> coefficients, double x) {
    double sum = 0;
    for (std::size_t n = coefficients.size(); n-- > 0;) sum = sum * x + coefficients[n];
    return sum;
}

TEST(BatchRig, KnowsWhenContactsPeakAndEnd) {
    for (const double damping_of_stop : {0.1, 0.5}) {
        const double stiffness = 400;
        const Rig rig(
            {.damping_ratio = 0.02,
             .contact = scene::KelvinVoigt<double>{stiffness, 2 * damping_of_stop * std::sqrt(stiffness)},
             .frequency = 2});
        ASSERT_TRUE(rig.fit);
        ASSERT_GT(rig.largest_pull, 0);
        for (const double share : {-0.9, -0.4, 0.0, 0.3, 0.8}) {
            const Ends ends = followed(rig, share * rig.pull_scale);
            EXPECT_NEAR((rig.exit_time + at(rig.exit_shift, share)) / ends.exit, 1, 1e-5) << share;
            if (rig.peak_time > 0) {
                EXPECT_NEAR((rig.peak_time + at(rig.peak_shift, share)) / ends.peak, 1, 1e-5) << share;
            }
        }
    }
}

// Of a contact whose shape is proved, the force has its maximum before it falls, and its zero after.
TEST(BatchRig, ProvesTheShapeOfContacts) {
    const Rig rig({.damping_ratio = 0.02, .contact = scene::KelvinVoigt<double>{400, 4}, .frequency = 2});
    EXPECT_LT(rig.least_pull, 0);
    EXPECT_GT(rig.largest_pull, 0);
    EXPECT_GT(rig.largest_jerk, 0);
    EXPECT_LT(rig.exit_time, rig.latest_exit);
    for (const double pull : {rig.least_pull, 0.0, rig.largest_pull}) {
        const Ends ends = followed(rig, pull);
        EXPECT_GT(ends.exit, rig.falls_from);
        EXPECT_LE(ends.peak, rig.falls_from);
    }
}

// The solution of x'' + 2 b x' + w2 x = 0 from (0, 1), in closed form.
TEST(BatchRig, HasTheSeriesOfAShortContact) {
    const Rig rig({.damping_ratio = 0.1, .contact = scene::KelvinVoigt<double>{30, 2}, .frequency = 2});
    for (const double t : {0.05, 0.2}) {
        const double decay = std::exp(-rig.contact_decay * t);
        const double turn = rig.contact_rate * t;
        const double x = decay * std::sin(turn) / rig.contact_rate;
        EXPECT_NEAR(at(rig.series, t), x, 1e-14);
        EXPECT_NEAR(at(rig.slope_series, t), decay * std::cos(turn) - rig.contact_decay * x, 1e-14);
    }
}

}  // namespace
}  // namespace peterka::batch
