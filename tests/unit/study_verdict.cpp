// The judge of the stability study and its battery of scenes.
#include "study/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "job/read.hpp"
#include "job_examples.hpp"
#include "rig.hpp"
#include "study/battery.hpp"
#include "study/rigid_limit.hpp"

namespace peterka::study {
namespace {

using regime::Regime;
using testing::beam_170mm;
using testing::paper_rig;

Verdict judged(const scene::Oscillator<double>& oscillator) {
    return judge(oscillator, testing::start_at(oscillator));
}

TEST(Verdict, TellsRegimesOfThePapersRig) {
    struct Expected {
        double frequency, gap;
        Regime regime;
        int impacts, period;
    };
    // eight regular cells, among them 2/2, which is not 1/1, and 3/2
    for (const Expected& cell :
         {Expected{2.0, 0.0, Regime::periodic, 1, 1}, Expected{3.5, 0.3, Regime::periodic, 1, 2},
          Expected{2.75, 0.0, Regime::periodic, 2, 2}, Expected{3.1, 0.0, Regime::periodic, 3, 2},
          Expected{3.0, 4.0, Regime::no_impact, 0, 1}, Expected{0.5, -5, Regime::sustained_contact, 0, 1}}) {
        const Verdict verdict = judged(paper_rig(beam_170mm, cell.frequency, cell.gap));
        ASSERT_EQ(verdict.kind, Verdict::Kind::settled) << cell.frequency << " " << cell.gap;
        EXPECT_EQ(verdict.regime, cell.regime) << cell.frequency << " " << cell.gap;
        EXPECT_EQ(verdict.impacts, cell.impacts) << cell.frequency << " " << cell.gap;
        EXPECT_EQ(verdict.period, cell.period) << cell.frequency << " " << cell.gap;
    }
}

TEST(Verdict, TellsChaosAndMotionsThatNeverSettle) {
    EXPECT_EQ(judged(paper_rig(beam_170mm, 2.4, 1.0)).kind, Verdict::Kind::chaotic);
    auto grows = paper_rig(beam_170mm, 1.0, 1e6);
    grows.damping_ratio = 0;
    EXPECT_EQ(judged(grows).kind, Verdict::Kind::open);
    auto conservative = paper_rig(beam_170mm, 2.3, 10);
    conservative.damping_ratio = 0;
    conservative.kelvin_voigt().damping = 0;
    EXPECT_EQ(judged(conservative).regime, Regime::no_impact);
}

TEST(Battery, NamesAreUniqueWordsAndScenesAreWhatTheySay) {
    std::set<std::string> names;
    for (const char* name : battery_names()) {
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_EQ(std::string(name).find(' '), std::string::npos) << name;
    }
    EXPECT_EQ(names.size(), battery().size());
    job::Job job = job::examples::study(job::StudyTopic::stability);
    job.hammer = {.mass_kg = 0.298, .natural_frequency_hz = 4.5, .damping_ns_per_m = 0.06};
    job.contact = job::KelvinVoigt{5.5e6, 1.2e3};
    double stiffest = 0;
    for (const BatteryScene& scene : battery()) {
        const scene::Cell cell = cell_of(scene, job);
        EXPECT_TRUE(cell.start.allFinite()) << scene.name;
        EXPECT_NEAR(cell.start[0] + cell.oscillator.gap, scene.displacement_ratio, 1e-9) << scene.name;
        if (scene.restitution) {
            EXPECT_LE(cell.start[0], 0) << scene.name;
        }
        if (scene.contact_stiffness_n_per_m) {
            stiffest = std::max(stiffest, cell.oscillator.kelvin_voigt().stiffness);
            // zeta_i = ci/(2 sqrt(m ki)) of the rig, unless the scene gives one
            const auto& stop = cell.oscillator.kelvin_voigt();
            const double expected =
                scene.contact_damping_ratio.value_or(1.2e3 / (2 * std::sqrt(0.298 * 5.5e6)));
            EXPECT_NEAR(stop.damping / (2 * std::sqrt(stop.stiffness)), expected, 1e-12 * expected);
        }
    }
    EXPECT_NEAR(stiffest, 1e15 / 238.233, 1e8);
}

TEST(RigidLimit, HasTheSpeedsOfTheFormulas) {
    const RigidLimit limit;
    EXPECT_NEAR(limit.restitution(), 0.57174002758478, 1e-13);
    EXPECT_NEAR(limit.rigid_speed(), 10.33883402105, 1e-10);
    EXPECT_LT(std::abs(limit.compliant_speed(1e8) - limit.rigid_speed()), 1e-2);
}

// There the hammer may swing without impact, too, but not from its start, at rest at u = -1.
TEST(RigidLimit, FindsItsOrbitAtWideGapsToo) {
    for (const RigidLimit& limit :
         {RigidLimit{.frequency = 1.2, .gap = 6}, RigidLimit{.frequency = 1.3, .gap = 3},
          RigidLimit{.frequency = 1.6, .gap = 2.5}}) {
        EXPECT_NEAR(limit.compliant_speed(1e8), limit.rigid_speed(), 1e-2) << limit.frequency;
    }
}

}  // namespace
}  // namespace peterka::study
