// The shipped jobs are valid and are those of the paper.
#include <gtest/gtest.h>

#include <array>

#include "job/axis_key.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

Job shipped(const std::string& name) {
    return read_job_file(examples::source_folder() / "jobs" / name);
}

TEST(ShippedJobs, AreAllSound) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(examples::source_folder() / "jobs")) {
        if (entry.path().extension() != ".toml") continue;
        ++count;
        const Job job = read_job_file(entry.path());
        EXPECT_FALSE(job.title.empty()) << entry.path();
        // Tables 2 and 3 of the paper.
        EXPECT_EQ(job.hammer.mass_kg, 0.298) << entry.path();
        EXPECT_EQ(job.cart.amplitude_m, 0.89e-3) << entry.path();
        const auto is_stop = [](std::string_view key) { return key.starts_with("contact."); };
        if (law_of(job.contact) != ContactLaw::kelvin_voigt || has_axis(job, is_stop)) continue;
        EXPECT_EQ(job.contact, (Contact{KelvinVoigt{5.5e6, 1.2e3}})) << entry.path();
    }
    EXPECT_GE(count, 7);
}

TEST(ShippedJobs, ShowEveryContactLaw) {
    EXPECT_EQ(law_of(shipped("peterka_170mm.toml").contact), ContactLaw::kelvin_voigt);
    EXPECT_EQ(law_of(shipped("rigid_170mm.toml").contact), ContactLaw::restitution);
    EXPECT_EQ(law_of(shipped("hunt_crossley_170mm.toml").contact), ContactLaw::hunt_crossley);
}

struct Rig {
    const char* file;
    double natural_frequency_hz;
    double damping_ns_per_m;
    std::int64_t points;
};

TEST(ShippedJobs, MapsCoverThePlaneOfThePaper) {
    for (const Rig& rig :
         {Rig{"smoke.toml", 4.5, 0.06, 64}, Rig{"peterka_170mm.toml", 4.5, 0.06, 512},
          Rig{"peterka_150mm.toml", 5.25, 0.08, 512}, Rig{"peterka_135mm.toml", 6.5, 0.09, 512}}) {
        SCOPED_TRACE(rig.file);
        const Job job = shipped(rig.file);
        EXPECT_EQ(job.kind, Kind::map);
        EXPECT_EQ(job.hammer.natural_frequency_hz, rig.natural_frequency_hz);
        EXPECT_EQ(job.hammer.damping_ns_per_m, rig.damping_ns_per_m);
        EXPECT_EQ(job.columns, (Axis{0.5, 4.5, rig.points}));
        EXPECT_EQ(job.rows, (Axis{0, 5, rig.points}));
        EXPECT_EQ(job.start, Start{});
    }
}

TEST(ShippedJobs, SweepsGoUpAndDownAtTheGapsOfThePaper) {
    for (const Rig& rig : {Rig{"sweep_170mm.toml", 4.5, 0.06, 1401}, Rig{"sweep_150mm.toml", 5.25, 0.08, 1401},
                           Rig{"sweep_135mm.toml", 6.5, 0.09, 1401}}) {
        SCOPED_TRACE(rig.file);
        const Job job = shipped(rig.file);
        EXPECT_EQ(job.kind, Kind::sweep);
        EXPECT_EQ(job.hammer.natural_frequency_hz, rig.natural_frequency_hz);
        EXPECT_EQ(job.hammer.damping_ns_per_m, rig.damping_ns_per_m);
        EXPECT_EQ(job.columns.points, rig.points);
        ASSERT_EQ(job.sweep.gap_ratio.size(), 3U);
        for (const std::size_t i : {0U, 1U, 2U}) {
            const double gap_mm = job.sweep.gap_ratio[i] * 0.89;
            EXPECT_DOUBLE_EQ(gap_mm, (std::array{0.0, 1.0, 3.0}[i]));
        }
        EXPECT_EQ(job.sweep.direction, Direction::both);
    }
}

TEST(ShippedJobs, BasinsStandWhereThePaperDrawsThem) {
    EXPECT_EQ(shipped("basin_150mm.toml").operating_point, (OperatingPoint{1.80, 1.74}));
    EXPECT_EQ(shipped("basin_150mm_coexisting.toml").operating_point, (OperatingPoint{1.80, 1.60}));
    EXPECT_EQ(shipped("basin_135mm.toml").operating_point, (OperatingPoint{2.15, 1.60}));
    EXPECT_EQ(shipped("basin_150mm.toml").hammer.natural_frequency_hz, 5.25);
    EXPECT_EQ(shipped("basin_135mm.toml").hammer.natural_frequency_hz, 6.5);
    // Chaotic transients there last up to 8000 cycles: a cell must not be called chaotic before they end.
    EXPECT_GT(shipped("basin_135mm.toml").steady_state.chaos_cycles, 8000);
    EXPECT_GT(shipped("basin_135mm.toml").steady_state.max_cycles,
              shipped("basin_135mm.toml").steady_state.chaos_cycles);
}

TEST(ShippedJobs, TracesFollowTheCellsOfThePaper) {
    const auto hertz = [](const std::string& name) {
        return shipped(name).operating_point.frequency_ratio * 4.5;
    };
    EXPECT_NEAR(hertz("trace_170mm_9hz.toml"), 9.0, 1e-8);
    EXPECT_NEAR(hertz("trace_170mm_12hz.toml"), 12.25, 1e-8);
    EXPECT_NEAR(hertz("trace_170mm_15hz.toml"), 15.25, 1e-8);
    EXPECT_EQ(hertz("trace_170mm_release.toml"), 0);
    EXPECT_NEAR(shipped("trace_170mm_release.toml").start.displacement_ratio * 0.89, -5, 1e-3);  // mm
}

}  // namespace
}  // namespace peterka::job
