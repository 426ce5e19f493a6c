// The release test, with the cart at rest: free decay and single impacts against their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rig.hpp"
#include "trace/trace.hpp"

namespace peterka::trace {
namespace {

job::Job release(double displacement, double gap_ratio, double duration_s) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::trace;
    job.operating_point = {0, gap_ratio};
    job.start = {displacement, 0};
    job.trace.from = job::TraceBegin::start;
    job.trace.duration_s = duration_s;
    job.trace.samples_per_cycle = 100;
    job.trace.spectrum_to_hz = 100;
    return job;
}

TEST(Release, DecaysFreely) {
    job::Job job = release(-3, 10, 1.0);
    job.hammer.damping_ns_per_m = 1.0;  // zeta 0.06
    const scene::Scene scene(job);
    const Trace trace = make_trace(scene);
    EXPECT_FALSE(trace.course.cell);
    EXPECT_TRUE(trace.impacts.empty());
    ASSERT_EQ(trace.instants.size(), 451U);  // 4.5 natural periods in a second
    const double zeta = trace.course.oscillator.damping_ratio;
    const double swing = std::sqrt(1 - zeta * zeta);
    for (const Instant& instant : trace.instants) {
        const double t = instant.time;
        const Quantities q = quantities(trace.course.oscillator, instant);
        const double expected =
            -3 * std::exp(-zeta * t) * (std::cos(swing * t) + zeta / swing * std::sin(swing * t));
        EXPECT_NEAR(q.hammer(), expected, 1e-12);
        EXPECT_EQ(q.cart, 0);
        EXPECT_NEAR(q.acceleration, -q.hammer() - 2 * zeta * q.hammer_velocity(), 1e-12);
    }
}

// As in a map: with what the term would change, and not because there is one.
TEST(Release, OmitsACubicSpringThatChangesNothing) {
    job::Job job = release(-3, 10, 1.0);
    job.hammer.cubic_stiffness_n_per_m3 = 238.2325;
    EXPECT_EQ(make_trace(scene::Scene(job)).course.oscillator.cubic, 0);
    job.hammer.cubic_stiffness_n_per_m3 = 1e3 * 238.2325;
    EXPECT_GT(make_trace(scene::Scene(job)).course.oscillator.cubic, 0);
}

// On a stop so stiff that the springs have no effect during the collision; at gap 0 without damping of the
// springs the hammer returns as fast as it left.
TEST(Release, StrikesAsAFreeMassDoes) {
    const double stiffness = 1e12;  // kappa
    for (const double zeta : {0.1, 0.2, 0.47}) {
        job::Job job = release(-2, 0, 0.5);
        job.hammer.damping_ns_per_m = 0;
        const double k = job.hammer.stiffness();
        job.contact = job::KelvinVoigt{stiffness * k, 2 * zeta * std::sqrt(stiffness * k * job.hammer.mass_kg)};
        const Trace trace = make_trace(scene::Scene(job));
        ASSERT_GE(trace.impacts.size(), 4U);
        const double bend = std::sqrt(1 - zeta * zeta);
        const double phi = std::acos(zeta);
        const double restitution = std::exp(-2 * zeta * phi / bend);
        EXPECT_NEAR(trace.impacts[0].time, std::numbers::pi / 2, 1e-12);
        EXPECT_NEAR(trace.impacts[0].speed, 2, 1e-12);
        for (std::size_t n = 0; n < 3; ++n) {
            const Impact& impact = trace.impacts[n];
            const double free_peak = std::exp(-zeta * (3 * phi - std::numbers::pi) / bend);
            EXPECT_NEAR(impact.record.peak_force / (impact.speed * std::sqrt(stiffness)), free_peak, 1e-5);
            EXPECT_NEAR(impact.record.contact_time * std::sqrt(stiffness), 2 * phi / bend, 1e-5);
            EXPECT_NEAR(trace.impacts[n + 1].speed / impact.speed, restitution, 1e-5);
        }
    }
}

TEST(Release, IsTheSameByEveryEngineAndKeepsAStrongCubicSpring) {
    job::Job job = release(-4, 0.5, 0.6);
    job.hammer.cubic_stiffness_n_per_m3 = 2e4;
    job.solver.tolerance = 1e-7;
    job.solver.engine = job::EngineChoice::arkode;
    const Trace integrated = make_trace(scene::Scene(job));
    for (const auto form :
         {job::CubicForm::relative, job::CubicForm::absolute}) {  // the same for a cart at rest
        job.hammer.cubic = form;
        job.solver.engine = job::EngineChoice::automatic;
        const Trace split = make_trace(scene::Scene(job));
        EXPECT_EQ(split.course.settings.engine, regime::Engine::split);
        ASSERT_EQ(split.impacts.size(), integrated.impacts.size());
        for (std::size_t n = 0; n < split.impacts.size(); ++n) {
            EXPECT_NEAR(split.impacts[n].record.peak_force / integrated.impacts[n].record.peak_force, 1, 1e-6);
        }
    }
}

}  // namespace
}  // namespace peterka::trace
