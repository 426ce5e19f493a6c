// Spectra against the Fourier integrals of known signals, and against the equation of motion.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "rig.hpp"
#include "trace/spectrum.hpp"
#include "trace/trace.hpp"
#include "trace/transform.hpp"

namespace peterka::trace {
namespace {

using Complex = std::complex<double>;

// The stop holds the hammer at constant depth for a while: a rectangular force pulse.
TEST(Spectrum, OfARectangularPulse) {
    const scene::Oscillator<double> oscillator{.contact = scene::KelvinVoigt<double>{7, 0}, .frequency = 1};
    Transform transform(oscillator, 1, 5, 0.1, 401);
    transform.stretch(Phase::flight, 0, 2, [](double) { return State<double>(-1, 0); });
    transform.stretch(Phase::contact, 2, 0.5, [](double) { return State<double>(1, 0); });
    for (const std::size_t n : {0U, 3U, 50U, 400U}) {
        const double w = 0.1 * static_cast<double>(n);
        const Complex expected = w == 0 ? 3.5
                                        : 7.0 * std::polar(1.0, -w * 1.25) * 2.0 * std::sin(w * 0.25) /
                                              w;  // begins 1 after the window
        EXPECT_LT(std::abs(transform.lines()[n].force - expected), 1e-12) << w;
    }
}

// A free oscillation u = cos(t) of an undamped hammer in a cart at rest, cut to the window.
TEST(Spectrum, OfASine) {
    const scene::Oscillator<double> oscillator{.contact = scene::KelvinVoigt<double>{1, 0}, .gap = 10};
    const double length = 7;
    Transform transform(oscillator, 0, length, 0.1, 200);
    transform.stretch(Phase::flight, 0, 9,
                      [](double t) { return State<double>(std::cos(t) - 10, -std::sin(t)); });
    const auto swing = [&](double w) {  // integral of exp(i w t)
        return w == 0 ? Complex(length) : (std::polar(1.0, w * length) - 1.0) / Complex(0, w);
    };
    const auto& lines = transform.lines();
    for (const int n : {0, 3, 10, 77, 199}) {
        const double w = 0.1 * n;
        const Complex expected = -(swing(1 - w) + swing(-1 - w)) / 2.0;
        EXPECT_LT(std::abs(lines[static_cast<std::size_t>(n)].acceleration - expected), 1e-11) << n;
        EXPECT_EQ(std::abs(lines[static_cast<std::size_t>(n)].force), 0);
    }
}

job::Job alternating() {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::trace;
    job.operating_point = {12.25 / 4.5, 0};
    job.trace.cycles = 6;
    job.trace.spectrum_to_hz = 3000;
    return job;
}

// Line by line (1 - w^2 + 2 i zeta w) u = eta^2 - f: except at
// the forcing's own line, the hammer is driven by the stop.
TEST(Spectrum, OfAnOrbitObeysTheEquationOfMotion) {
    const Trace trace = make_trace(scene::Scene(alternating()));
    const auto& oscillator = trace.course.oscillator;
    const Spectrum& spectrum = trace.spectrum;
    ASSERT_EQ(trace.course.period, 2);
    EXPECT_NEAR(spectrum.step, oscillator.frequency / 2, 1e-12);
    ASSERT_GT(spectrum.lines(), 400);
    for (std::int64_t n = 1; n < spectrum.lines(); ++n) {
        if (n == 2) continue;
        const double w = static_cast<double>(n) * spectrum.step;
        const double compliance = w * w / std::abs(Complex(1 - w * w, 2 * oscillator.damping_ratio * w));
        const auto line = static_cast<std::size_t>(n);
        EXPECT_NEAR(spectrum.acceleration[line], compliance * spectrum.force[line], 1e-8 * spectrum.force[0]);
    }
    double impulses = 0;
    for (std::size_t n = 0; n < 2; ++n) impulses += trace.impacts[n].record.impulse;
    EXPECT_NEAR(spectrum.force[0], impulses / (2 * oscillator.period()), 1e-9 * spectrum.force[0]);
    EXPECT_NEAR(spectrum.acceleration[0], 0, 1e-8 * spectrum.force[0]);
}

// z = 1/1 on a rigid stop, r = 0.6 and zeta = 0.02: its speed at touch is known in closed form.
TEST(Spectrum, OfImpulses) {
    job::Job job = alternating();
    job.hammer.damping_ns_per_m.reset();
    job.hammer.damping_ratio = 0.02;
    job.contact = job::Restitution{0.6};
    job.operating_point = {2, 0};
    const Trace trace = make_trace(scene::Scene(job));
    ASSERT_EQ(trace.course.period, 1);
    const double impulse = 1.6 * 11.841323894932;
    EXPECT_NEAR(trace.spectrum.force[0], impulse / trace.course.oscillator.period(), 1e-9);
    EXPECT_NEAR(trace.spectrum.force[7], 2 * impulse / trace.course.oscillator.period(), 1e-9);
    EXPECT_NEAR(trace.spectrum.acceleration[0], 0, 1e-9);
}

TEST(Spectrum, OfAnImpactBeginsWithItsImpulse) {
    const Trace trace = make_trace(scene::Scene(alternating()));
    ASSERT_TRUE(trace.hardest->spectrum);
    const double impulse = trace.impacts[trace.hardest->index].record.impulse;
    EXPECT_NEAR(trace.hardest->spectrum->force[0] / impulse, 1, 1e-10);
}

}  // namespace
}  // namespace peterka::trace
