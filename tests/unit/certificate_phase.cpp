// The closed form of a phase against its equation: Taylor's series for short times, and flows that add up.
#include "certificate/phase.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peterka::certificate {
namespace {

// delta'' + c delta' + K delta = 0 from (1, 0) and (0, 1), by 60 terms of Taylor's series.
Matrix<double> series(double c, double k, double t) {
    const auto column = [&](double position, double velocity) {
        double coefficient = position;
        double next = velocity;
        double power = 1;
        Vector<double> sum{0, 0};
        for (int n = 0; n < 60; ++n) {
            sum.position += coefficient * power;
            sum.velocity += (n + 1) * next * power;
            const double after = (-c * (n + 1) * next - k * coefficient) / ((n + 1.0) * (n + 2.0));
            coefficient = next;
            next = after;
            power *= t;
        }
        return sum;
    };
    const Vector<double> first = column(1, 0);
    const Vector<double> second = column(0, 1);
    return {first.position, second.position, first.velocity, second.velocity};
}

void expect_near(const Matrix<double>& a, const Matrix<double>& b) {
    EXPECT_NEAR(a.a, b.a, 1e-11);
    EXPECT_NEAR(a.b, b.b, 1e-11);
    EXPECT_NEAR(a.c, b.c, 1e-11);
    EXPECT_NEAR(a.d, b.d, 1e-11);
}

// A weak and a strong damping, without oscillation, and one near the border.
TEST(CertificatePhase, ItsFlowSolvesTheEquation) {
    for (const double damping : {0.3, 3.98, 4.02, 7.0}) {
        const RigOf<double> rig{
            .damping_ratio = 0.05, .stiffness = 3, .damping = damping, .frequency = 2, .period = 3.14};
        const Phase<double> phase(rig, true);
        EXPECT_DOUBLE_EQ(phase.damping(), damping + 0.1);
        EXPECT_DOUBLE_EQ(phase.stiffness(), 4);
        for (const double t : {0.1, 0.5, 1.0}) expect_near(phase.flow(t), series(phase.damping(), 4, t));
        expect_near(phase.flow(1.0), phase.flow(0.4) * phase.flow(0.6));
    }
}

TEST(CertificatePhase, ItsSteadyMotionSolvesTheEquation) {
    const RigOf<double> rig{
        .damping_ratio = 0.05, .stiffness = 3, .damping = 0.4, .frequency = 2, .gap = 0.7, .period = 3.14};
    for (const bool presses : {false, true}) {
        const Phase<double> phase(rig, presses);
        for (const double angle : {0.0, 1.0, 4.0}) {
            const auto at = [&](double theta) {
                return phase.steady(SineCosineOf<double>{.sine = std::sin(theta), .cosine = std::cos(theta)});
            };
            const Vector<double> now = at(angle);
            constexpr double step = 1e-4;
            const Vector<double> before = at(angle - 2 * step);
            const Vector<double> after = at(angle + 2 * step);
            EXPECT_NEAR((after.position - before.position) / (2 * step), now.velocity, 1e-6);
            EXPECT_NEAR((after.velocity - before.velocity) / (2 * step),
                        phase.acceleration(now, std::sin(angle)), 1e-6);
        }
    }
}

}  // namespace
}  // namespace peterka::certificate
