// Lengths that look like millimetres given as metres, wherever a job may give one.
#include "job/remarks.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "job/read.hpp"

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

}  // namespace
}  // namespace peterka::job
