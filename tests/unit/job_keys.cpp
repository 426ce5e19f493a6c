// Every key of the job file is connected: it sets its own member, and changing it has an effect.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <vector>

#include "job/read.hpp"
#include "job/write.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

TEST(JobKeys, EachLandsInItsMember) {
    const Job job = read_job_text(R"(schema = 1
kind = "map"
title = "A map"
[hammer]
mass_kg = 0.3
natural_frequency_hz = 4.6
damping_ns_per_m = 0.07
cubic_stiffness_n_per_m3 = 238.5
cubic = "absolute"
[cart]
amplitude_m = 0.9e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 5_600_000
damping_ns_per_m = 1300
[axes]
frequency_ratio = { from = 0.6, to = 4.4, points = 33, scale = "log" }
gap_ratio.from = 0.1
gap_ratio.to = 5.1
gap_ratio.points = 0x2C
[start]
displacement_ratio = -0.25
velocity_ratio = 1.75
[steady_state]
max_cycles = 3001
max_period = 65
chaos_cycles = 1001
[solver]
engine = "split"
tolerance = 2e-9
omit_tolerance = 2e-3
[output]
fields = ["orbit", "multiplier"]
anonymous = true
[audit]
cells = 150
[certificate]
cells = "all"
[noise]
acceleration_m_s2_per_sqrt_hz = 0.05
amplitude_relative = 0.01
frequency_relative = 0.002
cycles = 20000
[refine]
levels = 2
[starts]
count = 65
displacement_ratio = [-4.5, 0.5]
velocity_ratio = [-3.5, 3]
attractors = 9
[limits]
failed_cells = 7
)",
                                  "map");
    EXPECT_EQ(job, examples::map());
}

// A second value for each key of a job; a missing key fails the test below.
const std::map<std::string, std::string> other_values{
    {"title", "\"Another title\""},
    {"hammer.mass_kg", "0.31"},
    {"hammer.natural_frequency_hz", "4.7"},
    {"hammer.stiffness_n_per_m", "241.0"},
    {"hammer.damping_ns_per_m", "0.08"},
    {"hammer.damping_ratio", "0.0042"},
    {"hammer.cubic_stiffness_n_per_m3", "239.5"},
    {"hammer.cubic", "\"relative\""},
    {"cart.amplitude_m", "0.001"},
    {"contact.stiffness_n_per_m", "5700000.0"},
    {"contact.damping_ns_per_m", "1400.0"},
    {"contact.coefficient", "0.65"},
    {"contact.stiffness_n_per_m_pow_n", "560000000.0"},
    {"contact.exponent", "2.0"},
    {"contact.dissipation_s_per_m", "0.35"},
    {"operating_point.frequency_ratio", "1.95"},
    {"operating_point.gap_ratio", "1.75"},
    {"operating_point.frequency_hz", "8.25"},
    {"operating_point.gap_m", "0.00125"},
    {"start.displacement_ratio", "-1.35"},
    {"start.velocity_ratio", "1.85"},
    {"start.displacement_m", "-0.00135"},
    {"start.velocity_m_per_s", "0.085"},
    {"steady_state.max_cycles", "4001"},
    {"steady_state.max_period", "66"},
    {"steady_state.chaos_cycles", "2001"},
    {"solver.engine", "\"auto\""},
    {"solver.tolerance", "3e-09"},
    {"solver.omit_tolerance", "0.003"},
    {"output.fields", "[\"lyapunov\"]"},
    {"audit.cells", "151"},
    {"certificate.cells", "12"},
    {"certificate.starts", "true"},
    {"noise.acceleration_m_s2_per_sqrt_hz", "0.06"},
    {"noise.amplitude_relative", "0.02"},
    {"noise.frequency_relative", "0.003"},
    {"noise.cycles", "30000"},
    {"refine.levels", "3"},
    {"starts.count", "66"},
    {"starts.displacement_ratio", "[-4.5, 0.25]"},
    {"starts.velocity_ratio", "[-3.5, 3.5]"},
    {"starts.displacement_m", "[-0.0045, 0.00025]"},
    {"starts.velocity_m_per_s", "[-0.35, 0.35]"},
    {"starts.attractors", "10"},
    {"limits.failed_cells", "8"},
    {"uncertainty.rigs", "49"},
    {"uncertainty.covariance.of", "[\"contact.stiffness_n_per_m\", \"cart.amplitude_m\"]"},
    {"uncertainty.covariance.mean", "[5700000.0, 0.001]"},
    {"uncertainty.covariance.matrix", "[[20000000000.0, -0.5], [-0.5, 1e-10]]"},
    {"uncertainty.contact.damping_ns_per_m.relative", "0.04"},
    {"uncertainty.hammer.mass_kg.standard_deviation", "0.003"},
    {"uncertainty.hammer.damping_ratio.from", "0.0035"},
    {"uncertainty.hammer.damping_ratio.to", "0.0055"},
    {"uncertainty.operating_point.frequency_ratio.from", "-0.02"},
    {"uncertainty.operating_point.frequency_ratio.to", "0.03"},
    {"curves.max_period", "5"},
    {"sweep.gap_ratio", "[2.5]"},
    {"sweep.gap_m", "[0.0025]"},
    {"sweep.direction", "\"independent\""},
    {"sweep.samples", "49"},
    {"study.frequency_ratio", "[3.5, 1.5]"},
    {"study.gap_ratio", "[0.5, -2.0]"},
    {"study.frequency_hz", "[15.5, 6.5]"},
    {"study.gap_m", "[0.0005, -0.002]"},
    {"study.tolerances", "[0.01]"},
    {"study.steps_per_cycle", "[200]"},
    {"study.cycles", "78"},
    {"study.repeats", "6"},
    {"trace.from", "\"steady_state\""},
    {"trace.cycles", "9"},
    {"trace.samples_per_cycle", "333"},
    {"trace.impact_window_s", "0.02"},
    {"trace.impact_samples", "444"},
    {"trace.spectrum_to_hz", "5000.0"},
};
// Keys with a single value in this version, or whose other values require other keys.
const std::set<std::string> fixed{"schema",    "kind",      "contact.law",  "study.topic",
                                  "trace.map", "trace.row", "trace.column", "trace.duration_s"};

// Jobs that differ only in these keys are the same.
const std::set<std::string> same_job{"title", "limits.failed_cells", "output.anonymous", "curves.max_period"};

std::string other_value(const std::string& key, const std::string& value) {
    if (value == "true" || value == "false") return value == "true" ? "false" : "true";
    if (other_values.contains(key)) return other_values.at(key);
    if (key.ends_with(".from")) return "1.25";
    if (key.ends_with(".to")) return "3.75";
    if (key.ends_with(".points")) return "55";
    if (key.ends_with(".scale")) return value == "\"log\"" ? "\"linear\"" : "\"log\"";
    return other_values.at(key);
}

std::map<std::string, std::string> keys_and_values(const std::string& resolved) {
    std::map<std::string, std::string> keys;
    std::istringstream lines(resolved);
    std::string table;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('[')) table = line.substr(1, line.find(']') - 1) + ".";
        const auto equals = line.find(" = ");
        if (line.starts_with('#') || equals == std::string::npos) continue;
        const std::string value = line.substr(equals + 3, line.find(" # ") - equals - 3);
        keys[table + line.substr(0, equals)] = value.substr(0, value.find_last_not_of(' ') + 1);
    }
    return keys;
}

void expect_every_key_to_be_wired_through(const Job& job, std::size_t least_keys = 25) {
    const std::string before = resolved_text(job);
    const auto keys = keys_and_values(before);
    ASSERT_GT(keys.size(), least_keys);
    for (const auto& [key, value] : keys) {
        if (fixed.contains(key)) continue;
        SCOPED_TRACE(key);
        const std::string other = other_value(key, value);
        const std::vector<std::string> overrides{key + "=" + other};
        const Job changed = read_job_text(before, "job", overrides);
        EXPECT_NE(changed, job);
        auto expected = keys;
        expected[key] = other;
        EXPECT_EQ(keys_and_values(resolved_text(changed)), expected);
        const bool is_identity = !same_job.contains(key);
        EXPECT_EQ(identity_text(changed) != identity_text(job), is_identity);
    }
}

TEST(JobKeys, OfAMapAreWiredThrough) {
    expect_every_key_to_be_wired_through(examples::map());
}

TEST(JobKeys, OfUncertainRigsAreWiredThrough) {
    expect_every_key_to_be_wired_through(examples::uncertain());
}

TEST(JobKeys, OfUncertainRigsLandInTheirMembers) {
    const std::string text = resolved_text(examples::map()) + R"(
[uncertainty.covariance]
of = ["contact.stiffness_n_per_m", "operating_point.gap_m"]
mean = [5.6e6, 1e-3]
matrix = [[1e10, -0.5], [-0.5, 1e-10]]
[uncertainty.contact]
damping_ns_per_m = { relative = 0.03 }
[uncertainty.hammer]
mass_kg = { standard_deviation = 0.002 }
damping_ratio = { from = 0.003, to = 0.005 }
[uncertainty.operating_point]
frequency_ratio = { from = -0.01, to = 0.02 }
)";
    const std::vector<std::string> overrides{"uncertainty.rigs=48", "title=\"Uncertain rigs\""};
    EXPECT_EQ(read_job_text(text, "map", overrides), examples::uncertain());
}

TEST(JobKeys, OfABasinAreWiredThrough) {
    expect_every_key_to_be_wired_through(examples::basin());
}

TEST(JobKeys, OfASweepAreWiredThrough) {
    expect_every_key_to_be_wired_through(examples::sweep());
}

TEST(JobKeys, OfARigidStopAreWiredThrough) {
    Job job = examples::map();
    job.contact = Restitution{.coefficient = 0.6};
    expect_every_key_to_be_wired_through(job);
}

TEST(JobKeys, OfANonlinearStopAreWiredThrough) {
    Job job = examples::map();
    job.contact = HuntCrossley{.stiffness_n_per_m_pow_n = 5.5e8, .exponent = 1.6, .dissipation_s_per_m = 0.3};
    job.solver.engine = EngineChoice::arkode;
    expect_every_key_to_be_wired_through(job);
}

TEST(JobKeys, OfStudiesAreWiredThrough) {
    for (const Job& job : examples::studies()) expect_every_key_to_be_wired_through(job, 14);
}

TEST(JobKeys, OfATraceAreWiredThrough) {
    expect_every_key_to_be_wired_through(examples::trace());
}

TEST(JobKeys, InSiUnitsAreWiredThrough) {
    for (const Job& job : examples::in_si_units()) expect_every_key_to_be_wired_through(job, 14);
}

// Whichever unit was given, cells have ratios, and those of a job without axes are its own.
TEST(JobKeys, InSiUnitsGiveTheRatiosOfTheRig) {
    const Job trace = read_job_text(resolved_text(examples::in_si_units().back()), "trace");
    EXPECT_DOUBLE_EQ(trace.operating_point.frequency_ratio, 8.5 / 4.6);
    EXPECT_DOUBLE_EQ(trace.operating_point.gap_ratio, 1.5 / 0.9);
    EXPECT_DOUBLE_EQ(trace.start.displacement_ratio, -0.25 / 0.9);
    EXPECT_DOUBLE_EQ(trace.start.velocity_ratio, 0.05 / (0.9e-3 * 2 * std::numbers::pi * 4.6));
}

TEST(JobKeys, ATraceOfACartAtRestLastsForATime) {
    const std::vector<std::string> overrides{"operating_point.frequency_ratio=0", "trace.duration_s=0.25"};
    const Job job = read_job_text(resolved_text(examples::trace()), "trace", overrides);
    EXPECT_EQ(job.operating_point.frequency_ratio, 0);
    EXPECT_EQ(job.trace.duration_s, 0.25);
}

// Keys that identify the cell are read, in tables that define the rig in other jobs.
TEST(JobKeys, ATraceOfAMapHasNoRigOfItsOwn) {
    const std::string head = "schema = 1\nkind = \"trace\"\n[trace]\nmap = \"a.h5\"\n";
    const Job by_index = read_job_text(head + "row = 3\ncolumn = 4\n", "by index");
    EXPECT_EQ(by_index.cell.map, "a.h5");
    EXPECT_EQ(by_index.cell.row, 3);
    EXPECT_EQ(by_index.cell.column, 4);
    EXPECT_TRUE(by_index.cell.values.empty());
    const Job by_value =
        read_job_text(head + "[operating_point]\nfrequency_ratio = 2\ngap_ratio = 0.5\n", "by value");
    EXPECT_EQ(by_value.cell.values, (std::map<std::string, double>{{"operating_point.frequency_ratio", 2},
                                                                   {"operating_point.gap_ratio", 0.5}}));
}

TEST(JobKeys, AStudyOfPrecisionHasRegularCellsByDefault) {
    Job job = examples::study(StudyTopic::work_precision);
    job.study = {};
    std::string text = identity_text(job);
    text = text.substr(0, text.find("[study]")) + "[study]\ntopic = \"work_precision\"\n";
    const Job read = read_job_text(text, "study");
    EXPECT_EQ(read.study, Study{});
    EXPECT_EQ(read.study.frequency_ratio.size(), 8U);
}

}  // namespace
}  // namespace peterka::job
