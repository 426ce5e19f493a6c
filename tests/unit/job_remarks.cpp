// Numbers that look as if given in another unit, wherever a job may give one.
#include "job/remarks.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "job/read.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

std::string rig(const std::string& amplitude_m) {
    return "schema = 1\n[hammer]\nmass_kg = 1.2\nnatural_frequency_hz = 22\ndamping_ratio = "
           "0.015\n[cart]\namplitude_m = " +
           amplitude_m +
           "\n[contact]\nlaw = \"kelvin_voigt\"\nstiffness_n_per_m = 1.7e7\ndamping_ns_per_m = 2400\n";
}

std::string map_to(const std::string& gap_m, const std::string& amplitude_m = "0.4e-3") {
    return "kind = \"map\"\ntitle = \"t\"\n" + rig(amplitude_m) +
           "[axes.frequency_hz]\nfrom = 15\nto = 90\npoints = 3\n[axes.gap_m]\nfrom = 0\nto = " + gap_m +
           "\npoints = 3\n";
}

std::string trace_at(const std::string& gap_m, const std::string& start_m) {
    return "kind = \"trace\"\ntitle = \"t\"\n" + rig("0.4e-3") +
           "[operating_point]\nfrequency_hz = 40\ngap_m = " + gap_m + "\n[start]\ndisplacement_m = " + start_m +
           "\nvelocity_m_per_s = 0\n[trace]\ncycles = 6\n";
}

std::vector<std::string> remarks_on(const std::string& text) {
    return remarks(read_job_text(text, "job"));
}

std::string basin_from(const std::string& start_m) {
    return "kind = \"basin\"\ntitle = \"t\"\n" + rig("0.4e-3") +
           "[operating_point]\nfrequency_hz = 40\ngap_m = 0.6e-3\n[axes.displacement_m]\nfrom = " + start_m +
           "\nto = 0\npoints = 3\n[axes.velocity_m_per_s]\nfrom = -1\nto = 1\npoints = 3\n";
}

std::string sweep_at(const std::string& gap_m) {
    return "kind = \"sweep\"\ntitle = \"t\"\n" + rig("0.4e-3") +
           "[axes.frequency_hz]\nfrom = 15\nto = 90\npoints = 3\n[sweep]\ngap_m = [0, " + gap_m + "]\n";
}

TEST(Remarks, OnBasinsSweepsAndTheStartsOfAMap) {
    EXPECT_TRUE(remarks_on(basin_from("-1e-3")).empty());
    EXPECT_EQ(remarks_on(basin_from("-1.0")).size(), 1U);
    EXPECT_TRUE(remarks_on(sweep_at("0.6e-3")).empty());
    EXPECT_EQ(remarks_on(sweep_at("0.6")).size(), 1U);
    const std::string starts = "[starts]\ncount = 4\ndisplacement_m = ";
    EXPECT_TRUE(remarks_on(map_to("1.5e-3") + starts + "[-1e-3, 0]\n").empty());
    EXPECT_EQ(remarks_on(map_to("1.5e-3") + starts + "[-1, 0]\n").size(), 1U);
}

TEST(Remarks, AnAmplitudeOfADecimetreIsTheLeast) {
    EXPECT_TRUE(remarks_on(map_to("1.5e-3", "0.0999")).empty());
    EXPECT_EQ(remarks_on(map_to("1.5e-3", "0.1")).size(), 1U);
}

TEST(Remarks, NoneOnMillimetresGivenAsSuch) {
    EXPECT_TRUE(remarks_on(map_to("1.5e-3")).empty());
    EXPECT_TRUE(remarks_on(map_to("0.04")).empty());  // a hundred amplitudes
    EXPECT_TRUE(remarks_on(trace_at("0.6e-3", "-1e-3")).empty());
}

TEST(Remarks, OnAGapAStartAndAnAmplitudeThatLookLikeMillimetres) {
    const auto gap = remarks_on(map_to("1.5"));
    ASSERT_EQ(gap.size(), 1U);
    EXPECT_EQ(
        gap[0],
        "the gap reaches 1.5 m, 3750 amplitudes of the cart: lengths are in metres, 1.5 mm would be 0.0015 m");
    EXPECT_EQ(remarks_on(trace_at("300", "-1e-3")).size(), 1U);
    const auto start = remarks_on(trace_at("0.6e-3", "-1.0"));
    ASSERT_EQ(start.size(), 1U);
    EXPECT_TRUE(start[0].starts_with("the start reaches 1 m")) << start[0];
    const auto amplitude = remarks_on(map_to("1.5e-3", "0.4"));
    ASSERT_EQ(amplitude.size(), 1U);
    EXPECT_EQ(amplitude[0], "the cart's amplitude is 0.4 m: lengths are in metres, 0.4 mm would be 0.0004 m");
}

// The one remark on a job after some of its text is replaced.
std::string remark_with(std::string text, const std::string& old, const std::string& now) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), now);
    const std::vector<std::string> all = remarks_on(text);
    EXPECT_EQ(all.size(), 1U) << now;
    return all.empty() ? "" : all.front();
}

std::string slow_trace() {
    std::string text = trace_at("0.6e-3", "0");
    const std::string hertz = "frequency_hz = 40";
    return text.replace(text.rfind(hertz), hertz.size(), "frequency_ratio = 1.8");
}

TEST(Remarks, OnNumbersOfTheRigInOtherUnits) {
    const std::string map = map_to("1.5e-3");
    EXPECT_EQ(remark_with(map, "mass_kg = 1.2", "mass_kg = 120"),
              "the hammer's mass is 120 kg: masses are in kilograms, 120 g would be 0.12 kg");
    EXPECT_EQ(remark_with(map, "damping_ratio = 0.015", "damping_ratio = 1.5"),
              "the hammer's damping ratio is 1.5: it is a share of critical damping, not a percentage, 1.5 % "
              "would be 0.015");
    EXPECT_TRUE(remark_with(map, "damping_ratio = 0.015", "damping_ns_per_m = 500")
                    .starts_with("the hammer's damping of 500 Ns/m is a damping ratio of 1.51: dampings are in "
                                 "Ns/m"));
    EXPECT_EQ(remark_with(map, "stiffness_n_per_m = 1.7e7", "stiffness_n_per_m = 1.7e4"),
              "the stop is only 0.741 times as stiff as the beam springs: stiffnesses are in N/m, 1.7e+04 N/mm "
              "would be 1.7e+07 N/m");
    EXPECT_EQ(remark_with(map, "damping_ns_per_m = 2400", "damping_ns_per_m = 2.4"),
              "the stop's damping is 0.00027 of the critical one and takes hardly anything: it is in Ns/m, 2.4 "
              "Ns/mm would be 2400 Ns/m");
    EXPECT_TRUE(remark_with(map, "damping_ns_per_m = 2400", "damping_ns_per_m = 2.4e6")
                    .starts_with("the stop's damping is 266 times the critical one"));
    EXPECT_TRUE(remark_with(map, "[cart]", "cubic_stiffness_n_per_m3 = 1e-4\n[cart]")
                    .ends_with("cubic stiffnesses are in N/m^3, 0.0001 N/mm^3 would be 1e+05 N/m^3"));
    EXPECT_EQ(
        remark_with(slow_trace(), "natural_frequency_hz = 22", "stiffness_n_per_m = 2.3"),
        "the hammer's natural frequency is 0.2203 Hz, on springs too soft to carry it: stiffnesses are in N/m, "
        "2.3 N/mm would be 2300 N/m");
    EXPECT_TRUE(remark_with(slow_trace(), "natural_frequency_hz = 22", "natural_frequency_hz = 0.022")
                    .ends_with("frequencies are in hertz, 0.022 kHz would be 22 Hz"));
}

TEST(Remarks, NoneOnAStopThatTakesNothingOrOnARigidOne) {
    const auto with = [](std::string text, const std::string& old, const std::string& now) {
        return remarks_on(text.replace(text.find(old), old.size(), now));
    };
    EXPECT_TRUE(with(map_to("1.5e-3"), "damping_ns_per_m = 2400", "damping_ns_per_m = 0").empty());
    EXPECT_TRUE(with(map_to("1.5e-3"),
                     "law = \"kelvin_voigt\"\nstiffness_n_per_m = 1.7e7\ndamping_ns_per_m = 2400",
                     "law = \"restitution\"\ncoefficient = 0.6")
                    .empty());
}

// A number that an axis varies is told only if it is doubtful in all cells.
TEST(Remarks, OnAnAxisOfStopsThatAreAllTooSoft) {
    const auto over = [](const std::string& to) {
        return "kind = \"map\"\ntitle = \"t\"\n" + rig("0.4e-3") +
               "[operating_point]\nfrequency_hz = 40\n[axes.contact.stiffness_n_per_m]\nfrom = 1e3\nto = " +
               to + "\npoints = 3\n[axes.gap_m]\nfrom = 0\nto = 1e-3\npoints = 3\n";
    };
    EXPECT_TRUE(remarks_on(over("1e8")).empty());
    EXPECT_EQ(remarks_on(over("1e4")).size(), 1U);
}

TEST(Remarks, OnFrequenciesInRadiansPerSecondAndOnRatiosThatAreNone) {
    const std::string map = map_to("1.5e-3");
    EXPECT_EQ(
        remark_with(map, "to = 90", "to = 570"),
        "the excitation frequency reaches 570 Hz, 25.9 times the hammer's natural one: frequencies are in "
        "hertz, 570 rad/s would be 90.72 Hz");
    std::string stiff = map;
    stiff.replace(stiff.find("1.7e7"), 5, "1.7e9");  // also against springs of 138 Hz
    EXPECT_EQ(remark_with(stiff, "natural_frequency_hz = 22", "natural_frequency_hz = 138"),
              "no excitation frequency comes near the hammer's natural one of 138 Hz, the highest is 90 Hz: "
              "frequencies are in hertz, 138 rad/s would be 21.96 Hz");
    EXPECT_EQ(remark_with(map, "[axes.frequency_hz]", "[axes.frequency_ratio]"),
              "frequency_ratio reaches 90: it is Omega/omega, the excitation over the natural frequency of the "
              "hammer; a frequency in hertz is frequency_hz");
    EXPECT_EQ(remark_with(map, "[axes.gap_m]", "[axes.gap_ratio]"),
              "gap_ratio reaches no more than 0.0015 amplitudes of the cart: it is gap/A0; a gap in metres is "
              "gap_m");
}

// Of metres and of ratios alike: the hammer would follow the cart for ever.
TEST(Remarks, OnAPrecompressionThatNoMotionOvercomes) {
    const auto from = [](const std::string& key, const std::string& gap) {
        std::string text = map_to("1.5e-3");
        text.replace(text.find("[axes.gap_m]\nfrom = 0\nto = 1.5e-3"), 33,
                     "[axes." + key + "]\nfrom = " + gap + "\nto = 1.0");
        return text;
    };
    const auto metre = remarks_on(from("gap_m", "-1.0"));
    ASSERT_EQ(metre.size(), 1U);
    EXPECT_EQ(
        metre[0],
        "the gap reaches -1 m, 2500 amplitudes of the cart: lengths are in metres, -1 mm would be -0.001 m");
    EXPECT_TRUE(remarks_on(from("gap_ratio", "-150")).empty());
    const auto ratio = remarks_on(from("gap_ratio", "-200"));
    ASSERT_EQ(ratio.size(), 1U);
    EXPECT_EQ(ratio[0],
              "a gap of -0.08 m presses the hammer on its stop by 1834 N, 12 times what takes it off at the "
              "highest frequency: a negative gap is a precompression in amplitudes of the cart");
}

TEST(Remarks, OnVelocitiesAndTimes) {
    const std::string trace = trace_at("0.6e-3", "0");
    EXPECT_TRUE(remark_with(trace, "velocity_m_per_s = 0", "velocity_m_per_s = 25")
                    .ends_with("velocities are in m/s, 25 mm/s would be 0.025 m/s"));
    EXPECT_EQ(
        remark_with(trace, "cycles = 6", "impact_window_s = 3"),
        "trace.impact_window_s is 3 s, 66 natural periods of the hammer: times are in seconds, 3 ms would "
        "be 0.003 s");
    EXPECT_EQ(
        remark_with(trace, "cycles = 6", "spectrum_to_hz = 8"),
        "trace.spectrum_to_hz is 8 Hz, and the hammer moves at 40 Hz: frequencies are in hertz, 8 kHz would "
        "be 8000 Hz");
}

std::string uncertain(const std::string& spreads) {
    return map_to("1.5e-3") + "[uncertainty]\nrigs = 20\n" + spreads;
}

TEST(Remarks, OnSpreadsInPercentOrInAnotherUnit) {
    const auto one = [](const std::string& spreads) {
        const auto all = remarks_on(uncertain(spreads));
        EXPECT_EQ(all.size(), 1U) << spreads;
        return all.empty() ? "" : all.front();
    };
    EXPECT_TRUE(remarks_on(uncertain("contact.stiffness_n_per_m.relative = 0.05\n")).empty());
    EXPECT_EQ(
        one("contact.stiffness_n_per_m.relative = 5\n"),
        "uncertainty.contact.stiffness_n_per_m.relative = 5 is a standard deviation of 500 % of the job's own "
        "value: it is a share, not a percentage, 5 % is 0.05");
    EXPECT_EQ(
        one("operating_point.gap_m.standard_deviation = 0.02\n"),
        "uncertainty.operating_point.gap_m has a standard deviation of 0.02 m, 13.3 times the largest value "
        "that it has in the job, 0.0015 m: it has the unit of the key, and is no percentage");
    EXPECT_TRUE(one("operating_point.gap_m = { from = -1, to = 1 }\n")
                    .starts_with("uncertainty.operating_point.gap_m has a standard deviation of 0.5774 m"));
    EXPECT_EQ(one("hammer.mass_kg = { from = 1190, to = 1210 }\n"),
              "uncertainty.hammer.mass_kg is drawn from 1190 kg to 1210 kg, and the job's own value is 1.2 kg, "
              "which is not among them: both have the unit of the key");
    EXPECT_TRUE(remarks_on(uncertain("hammer.mass_kg = { from = 1.19, to = 1.21 }\n")).empty());
    EXPECT_TRUE(one("[uncertainty.covariance]\nof = [\"hammer.mass_kg\"]\nmean = [1.2]\nmatrix = [[9.0]]\n")
                    .starts_with("uncertainty.hammer.mass_kg has a standard deviation of 3 kg, 2.5 times"));
}

// What the paper's and the gallery's jobs give is meant so.
TEST(Remarks, NoneOnTheShippedJobs) {
    const std::filesystem::path jobs = examples::source_folder() / "jobs";
    int count = 0;
    for (const std::filesystem::path& folder : {jobs, jobs / "gallery"}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".toml") continue;
            ++count;
            EXPECT_TRUE(remarks(read_job_file(entry.path())).empty()) << entry.path();
        }
    }
    EXPECT_GT(count, 20);
}

}  // namespace
}  // namespace peterka::job
