// The resolved text is a job that reads back bit for bit; the identity text distinguishes jobs.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

#include "job/names.hpp"
#include "job/read.hpp"
#include "job/rules.hpp"
#include "job/write.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

// Seeded jobs that cover the checker's ranges.
class RandomJobs {
  public:
    explicit RandomJobs(std::uint64_t seed) : random_(seed) {}

    Job next() {
        Job job;
        job.kind = coin() ? Kind::map : Kind::basin;
        job.title = title();
        job.hammer.mass_kg = magnitude();
        (coin() ? job.hammer.natural_frequency_hz : job.hammer.stiffness_n_per_m) = magnitude();
        (coin() ? job.hammer.damping_ns_per_m : job.hammer.damping_ratio) = coin() ? 0.0 : magnitude();
        job.hammer.cubic = coin() ? CubicForm::relative : CubicForm::absolute;
        job.cart.amplitude_m = magnitude();
        job.contact = contact();
        const bool is_map = job.kind == Kind::map;
        job.columns = is_map ? axis(1e-6, 1e6) : axis(-1e9, 1e9);
        job.rows = is_map ? axis(-1e6, 1e6) : axis(-1e9, 1e9);
        if (is_map) {
            job.start = {signed_number(1e9), signed_number(1e9)};
            job.refine.levels = integer(0, 6);
            if (coin()) {
                job.starts = {.count = integer(1, 1'000'000),
                              .displacement_ratio = {job.rows.from - uniform(1, 1e6), job.rows.from + 1},
                              .velocity_ratio = {uniform(-1e9, 0), uniform(1, 1e9)},
                              .attractors = integer(1, 64)};
            }
        } else {
            job.operating_point = {uniform(1e-6, 1e6), signed_number(1e6)};
        }
        job.steady_state = {integer(1, 1'000'000'000), integer(1, 1024), integer(1, 1'000'000'000)};
        job.solver = {coin() ? EngineChoice::automatic : EngineChoice::exact, std::exp(uniform(-27.6, -2.4)),
                      coin() ? 0.0 : std::exp(uniform(-744, 0))};
        if (std::holds_alternative<HuntCrossley>(job.contact)) job.solver.engine = EngineChoice::automatic;
        if (std::holds_alternative<Restitution>(job.contact)) keep_starts_before_the_stop(job);
        if (job.solver.engine != EngineChoice::exact && coin())
            job.hammer.cubic_stiffness_n_per_m3 = magnitude();
        for (const auto& field : Names<OptionalField>::all) {
            const bool is_kick = field.value == OptionalField::critical_kick;
            if (!coin() || (is_kick && job.starts.count == 0 && job.kind != Kind::map)) continue;
            job.output.fields.push_back(field.value);
            if (!rule_of_elasticities(job).empty()) job.output.fields.pop_back();
        }
        job.output.anonymous = coin();
        job.audit.cells = integer(0, 1'000'000);
        job.certificate.cells = coin() ? every_cell : integer(0, every_cell);
        job.certificate.starts = coin();
        job.certificate.many_digits = job.certificate.starts && coin();
        job.certificate.attractors = coin();
        if (!rule_of_proved_attractors(job).empty()) job.certificate.attractors = false;
        if (coin() && (job.kind == Kind::map || job.kind == Kind::sweep)) {
            job.noise.acceleration_m_s2_per_sqrt_hz = uniform(0, 1e3);
            job.noise.amplitude_relative = uniform(0, 0.1);
            job.noise.frequency_relative = uniform(0, 0.1);
            job.noise.cycles = integer(1'000, 1'000'000'000);
        }
        job.limits.failed_cells = integer(0, std::numeric_limits<std::int64_t>::max());
        return job;
    }

  private:
    bool coin() { return (random_() & 1U) != 0; }
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    std::int64_t integer(std::int64_t low, std::int64_t high) {
        return std::uniform_int_distribution(low, high)(random_);
    }
    double magnitude() { return std::exp(uniform(std::log(1e-29), std::log(1e29))); }
    double signed_number(double limit) {
        const double small = std::ldexp(uniform(-1, 1), -static_cast<int>(integer(0, 1074)));
        return coin() ? uniform(-limit, limit) : coin() ? small : -0.0;
    }
    Contact contact() {
        switch (integer(0, 2)) {
            case 0:
                return KelvinVoigt{magnitude(), coin() ? 0.0 : magnitude()};
            case 1:
                return Restitution{coin() ? uniform(0, 1) : 1.0};
            default:
                return HuntCrossley{magnitude(), uniform(1, 10), coin() ? 0.0 : magnitude()};
        }
    }
    static void keep_starts_before_the_stop(Job& job) {
        if (job.kind == Kind::map)
            job.start.displacement_ratio = std::min(job.start.displacement_ratio, job.rows.from);
        if (job.kind == Kind::basin && job.columns.to > job.operating_point.gap_ratio)
            job.contact = KelvinVoigt{1, 1};
    }
    Axis axis(double low, double high) {
        const double one = uniform(low, high);
        const double other = uniform(low, high);
        Axis axis{std::min(one, other), std::max(one, other), integer(2, 100'000), Spacing::linear};
        if (axis.from > 0 && coin()) axis.scale = Spacing::log;
        return axis;
    }
    std::string title() {
        const std::vector<std::string> pieces{"a", "\"", "\\",      "é", "Ω/ω",    "#",
                                              " ", "'",  "\\u0041", "=", "\u00a0", "😀"};
        std::string title;
        for (std::int64_t i = integer(0, 20); i > 0; --i) title += pieces[random_() % pieces.size()];
        return title;
    }

    std::mt19937_64 random_;
};

std::vector<std::uint64_t> bits_of(const Job& job) {
    std::vector<std::uint64_t> bits;
    const auto add = [&](double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); };
    const Hammer& hammer = job.hammer;
    for (const auto& value : {hammer.natural_frequency_hz, hammer.stiffness_n_per_m, hammer.damping_ns_per_m,
                              hammer.damping_ratio}) {
        add(value.value_or(-1));
    }
    for (const double value :
         {hammer.mass_kg, hammer.cubic_stiffness_n_per_m3, job.cart.amplitude_m, job.columns.from,
          job.columns.to, job.rows.from, job.rows.to, job.operating_point.frequency_ratio,
          job.operating_point.gap_ratio, job.start.displacement_ratio, job.start.velocity_ratio,
          job.solver.tolerance, job.solver.omit_tolerance}) {
        add(value);
    }
    const auto add_all = [&](std::initializer_list<double> values) { std::ranges::for_each(values, add); };
    if (const auto* stop = std::get_if<KelvinVoigt>(&job.contact)) {
        add_all({stop->stiffness_n_per_m, stop->damping_ns_per_m});
    }
    if (const auto* stop = std::get_if<Restitution>(&job.contact)) add(stop->coefficient);
    if (const auto* stop = std::get_if<HuntCrossley>(&job.contact)) {
        add_all({stop->stiffness_n_per_m_pow_n, stop->exponent, stop->dissipation_s_per_m});
    }
    return bits;
}

TEST(JobRoundTrip, RandomJobsReadBackEqualBitForBit) {
    RandomJobs jobs(20240607);
    for (int i = 0; i < 2000; ++i) {
        const Job job = jobs.next();
        const std::string text = resolved_text(job);
        const Job again = read_job_text(text, "resolved");
        ASSERT_EQ(again, job) << text;
        ASSERT_EQ(bits_of(again), bits_of(job)) << text;
        ASSERT_EQ(resolved_text(again), text);
    }
}

TEST(JobRoundTrip, ExamplesReadBackEqual) {
    EXPECT_EQ(read_job_text(resolved_text(examples::map()), "map"), examples::map());
    EXPECT_EQ(read_job_text(resolved_text(examples::basin()), "basin"), examples::basin());
    EXPECT_EQ(read_job_text(resolved_text(examples::sweep()), "sweep"), examples::sweep());
    EXPECT_EQ(read_job_text(resolved_text(examples::trace()), "trace"), examples::trace());
    for (const Job& job : examples::studies()) EXPECT_EQ(read_job_text(resolved_text(job), "study"), job);
}

TEST(JobIdentity, HasNoTitleNoLimitsAndNoComments) {
    for (const Job& job : {examples::map(), examples::basin(), examples::sweep()}) {
        const std::string text = identity_text(job);
        EXPECT_EQ(text.find("title"), std::string::npos);
        EXPECT_EQ(text.find("limits"), std::string::npos);
        EXPECT_EQ(text.find('#'), std::string::npos);
        EXPECT_EQ(identity_text(read_job_text(text, "identity")), text);
    }
}

TEST(JobIdentity, OfAStudyReadsBack) {
    for (const Job& job : examples::studies()) {
        const std::string text = identity_text(job);
        EXPECT_EQ(text.find("title"), std::string::npos);
        EXPECT_EQ(identity_text(read_job_text(text, "identity")), text);
    }
}

TEST(JobIdentity, DoesNotDependOnHowAJobIsWritten) {
    const std::string given = resolved_text(examples::map());
    std::string other = given;
    other.replace(other.find("5600000.0"), 9, "5.6e+006 ");
    other.replace(other.find("[\"multiplier\", \"orbit\"]"), 23, "[\"orbit\", \"multiplier\"]");
    EXPECT_EQ(identity_text(read_job_text(other, "other")), identity_text(examples::map()));
}

TEST(ResolvedText, NamesUnitsAndDerivedNumbers) {
    Job job = examples::map();
    job.hammer = {.mass_kg = 0.298, .natural_frequency_hz = 4.5, .damping_ns_per_m = 0.06};
    job.contact = KelvinVoigt{5.5e6, 1.2e3};
    const std::string text = resolved_text(job);
    EXPECT_NE(text.find("mass_kg = 0.298                         # mass of the hammer [kg]\n"),
              std::string::npos);
    EXPECT_NE(
        text.find(
            "# Derived: omega = 28.2743 rad/s (4.5 Hz), k = 238.233 N/m, c = 0.06 Ns/m,\n"
            "# zeta = c/(2 m omega) = 0.00356051, kappa = ki/k = 23086.7, chi = ci/(m omega) = 142.421\n"),
        std::string::npos)
        << text;
}

}  // namespace
}  // namespace peterka::job
