// `rig = "FILE"`: what a job takes from a rig's file, and the messages for unusable ones.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "job/read.hpp"
#include "job/write.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

namespace fs = std::filesystem;

const std::string job_head = "schema = 1\nkind = \"map\"\n";
const std::string hammer_table =
    "[hammer]\nmass_kg = 0.3\nnatural_frequency_hz = 4.5\ndamping_ns_per_m = 0.06\n";
const std::string cart_table = "[cart]\namplitude_m = 0.89e-3\n";
const std::string contact_table =
    "[contact]\nlaw = \"kelvin_voigt\"\nstiffness_n_per_m = 5.5e6\ndamping_ns_per_m = 1.2e3\n";
const std::string axes_tables =
    "[axes.frequency_ratio]\nfrom = 1\nto = 2\npoints = 3\n[axes.gap_ratio]\nfrom = 0\nto = 1\npoints = 4\n";

class RigFiles : public testing::Test {
  protected:
    RigFiles() : folder_(fs::temp_directory_path() / fs::path("peterka_rigs_" + std::to_string(getpid()))) {
        fs::create_directories(folder_ / "rigs");
    }
    ~RigFiles() override { fs::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    [[nodiscard]] Job job(const std::string& text, const std::vector<std::string>& overrides = {}) const {
        write("job.toml", text);
        return read_job_file(folder_ / "job.toml", overrides);
    }
    // With the folder omitted.
    [[nodiscard]] std::string complaint_about(const std::string& text) const {
        try {
            (void)job(text);
        } catch (const JobFaults& faults) {
            std::string words = faults.what();
            const std::string prefix = folder_.string() + "/";
            for (auto at = words.find(prefix); at != std::string::npos; at = words.find(prefix)) {
                words.erase(at, prefix.size());
            }
            return words;
        }
        return "accepted";
    }

    fs::path folder_;
};

TEST_F(RigFiles, AJobWithARigIsTheJobWithItsNumbers) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    const Job with_rig = job(job_head + "rig = \"rigs/mine.toml\"\n" + axes_tables);
    const Job with_numbers =
        read_job_text(job_head + hammer_table + cart_table + contact_table + axes_tables, "job");
    EXPECT_EQ(with_rig, with_numbers);
    EXPECT_EQ(resolved_text(with_rig), resolved_text(with_numbers));
    EXPECT_EQ(identity_text(with_rig), identity_text(with_numbers));
}

TEST_F(RigFiles, WhatTheJobGivesWins) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    const Job own =
        job(job_head + "rig = \"rigs/mine.toml\"\n[cart]\namplitude_m = 2e-3\n[hammer]\nmass_kg = 0.5\n" +
                axes_tables,
            {"contact.damping_ns_per_m=7"});
    EXPECT_EQ(own.cart.amplitude_m, 2e-3);
    EXPECT_EQ(own.hammer.mass_kg, 0.5);
    EXPECT_EQ(own.hammer.natural_frequency_hz, 4.5);
    EXPECT_EQ(own.contact, (Contact{KelvinVoigt{5.5e6, 7}}));
}

TEST_F(RigFiles, OneOfTwoKeysTakesThePlaceOfTheOther) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    const Job own =
        job(job_head + "rig = \"rigs/mine.toml\"\n[hammer]\nstiffness_n_per_m = 200\ndamping_ratio = 0.01\n" +
            axes_tables);
    EXPECT_EQ(own.hammer.stiffness_n_per_m, 200);
    EXPECT_EQ(own.hammer.damping_ratio, 0.01);
    EXPECT_FALSE(own.hammer.natural_frequency_hz || own.hammer.damping_ns_per_m);
}

TEST_F(RigFiles, AContactWithAnotherLawReplacesTheWholeTable) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    const Job rigid =
        job(job_head + "rig = \"rigs/mine.toml\"\n[contact]\nlaw = \"restitution\"\ncoefficient = 0.5\n" +
            axes_tables);
    EXPECT_EQ(rigid.contact, (Contact{Restitution{0.5}}));
    const Job same =
        job(job_head + "rig = \"rigs/mine.toml\"\n[contact]\nlaw = \"kelvin_voigt\"\ndamping_ns_per_m = 3\n" +
            axes_tables);
    EXPECT_EQ(same.contact, (Contact{KelvinVoigt{5.5e6, 3}}));
}

TEST_F(RigFiles, ARigMayBeginFromAnotherThatLiesBesideIt) {
    write("rigs/base.toml", hammer_table + cart_table + contact_table);
    write("rigs/heavy.toml", "rig = \"base.toml\"\n[hammer]\nmass_kg = 0.9\n");
    const Job heavy = job(job_head + "rig = \"rigs/heavy.toml\"\n" + axes_tables);
    EXPECT_EQ(heavy.hammer.mass_kg, 0.9);
    EXPECT_EQ(heavy.cart.amplitude_m, 0.89e-3);
}

TEST_F(RigFiles, AChainOfRigsHasAnEnd) {
    const auto chain_of = [&](int rigs) {
        for (int i = 1; i < rigs; ++i) {
            write("rigs/" + std::to_string(i) + ".toml", "rig = \"" + std::to_string(i + 1) + ".toml\"\n");
        }
        write("rigs/" + std::to_string(rigs) + ".toml", hammer_table + cart_table + contact_table);
        return complaint_about(job_head + "rig = \"rigs/1.toml\"\n" + axes_tables);
    };
    EXPECT_EQ(chain_of(16), "accepted");
    for (const int rigs : {17, 300}) {
        EXPECT_NE(chain_of(rigs).find("is the end of a chain of more than 16 rigs"), std::string::npos);
    }
}

TEST_F(RigFiles, AnOverrideNamesAnotherRig) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    write("rigs/other.toml", "rig = \"mine.toml\"\n[cart]\namplitude_m = 3e-3\n");
    EXPECT_EQ(
        job(job_head + "rig = \"rigs/mine.toml\"\n" + axes_tables, {"rig=rigs/other.toml"}).cart.amplitude_m,
        3e-3);
}

TEST_F(RigFiles, FaultsOfARigAreToldWhereTheyAre) {
    write("rigs/mine.toml", "[hammer]\nmass_kg = -1\nnatural_frequency_hz = 4.5\ndamping_ns_per_m = 0\n" +
                                cart_table + contact_table);
    EXPECT_EQ(
        complaint_about(job_head + "rig = \"rigs/mine.toml\"\n" + axes_tables),
        "rigs/mine.toml:2:11: hammer.mass_kg = -1 is out of range; a mass must be positive: the hammer has "
        "inertia; give a value from 1e-30 to 1e+30");
}

TEST_F(RigFiles, WhatDoesNotFitTogetherIsToldWhereTheJobSaysIt) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    const std::string trace =
        "schema = 1\nkind = \"trace\"\nrig = \"rigs/mine.toml\"\n[operating_point]\nfrequency_ratio = 2.0\n"
        "gap_ratio = 0.0\n[trace]\ncycles = 10000\nsamples_per_cycle = 100000\n";
    EXPECT_EQ(complaint_about(trace).substr(0, 40), "job.toml:7:1: the trace would have 1e+09");
}

TEST_F(RigFiles, WhatDoesNotFitTogetherInARigIsToldThere) {
    write("rigs/mine.toml", hammer_table + cart_table +
                                "[contact]\nlaw = \"hunt_crossley\"\nexponent = 1.5\n"
                                "stiffness_n_per_m_pow_n = 5.5e8\ndissipation_s_per_m = 0.3\n");
    const std::string curves = "schema = 1\nkind = \"curves\"\nrig = \"rigs/mine.toml\"\n" + axes_tables;
    EXPECT_EQ(complaint_about(curves).substr(0, 48), "rigs/mine.toml:7:1: curves need contact.law = \"k");
}

TEST_F(RigFiles, MissingOnesAreNamedWithTheOneThatIsMeant) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    EXPECT_EQ(complaint_about(job_head + "rig = \"rigs/mime.toml\"\n" + axes_tables),
              "job.toml:3:7: rig = \"rigs/mime.toml\" names a file that isn't there; it is looked for from the "
              "folder of the file that names it, as rigs/mime.toml; did you mean \"rigs/mine.toml\"?");
    EXPECT_NE(
        complaint_about(job_head + "rig = \"nowhere/at_all.toml\"\n" + axes_tables).find("; check the path"),
        std::string::npos);
}

TEST_F(RigFiles, OnesThatLeadInACircleAreRefused) {
    write("rigs/a.toml", "rig = \"b.toml\"\n" + cart_table);
    write("rigs/b.toml", "rig = \"a.toml\"\n" + hammer_table);
    EXPECT_EQ(
        complaint_about(job_head + "rig = \"rigs/a.toml\"\n" + axes_tables),
        "rigs/b.toml:1:7: rig = \"a.toml\" leads back to where it came from (rigs/a.toml -> rigs/b.toml -> "
        "rigs/a.toml); a rig may begin from another one, but not from itself; remove one of these lines");
    EXPECT_NE(complaint_about(job_head + "rig = \"job.toml\"\n" + axes_tables).find("leads back"),
              std::string::npos);
}

TEST_F(RigFiles, OtherFilesAreNoRigs) {
    write("other.toml", job_head + hammer_table + cart_table + contact_table + axes_tables);
    EXPECT_EQ(
        complaint_about(job_head + "rig = \"other.toml\"\n" + axes_tables),
        "job.toml:3:7: rig = \"other.toml\" names no rig: that file has axes, kind, schema, too; a rig file "
        "has [hammer], [cart] and [contact] or some of them, may name another rig, and has nothing else; "
        "name the file of a rig, or move these tables of that file into one");
    write("empty.toml", "# nothing\n");
    EXPECT_NE(complaint_about(job_head + "rig = \"empty.toml\"\n" + axes_tables).find("that file has no table"),
              std::string::npos);
    write("torn.toml", "[hammer\n");
    EXPECT_NE(complaint_about(job_head + "rig = \"torn.toml\"\n" + axes_tables)
                  .find("job.toml:3:7: rig = \"torn.toml\" can't be read as a rig; torn.toml:1:8: TOML syntax"),
              std::string::npos)
        << complaint_about(job_head + "rig = \"torn.toml\"\n" + axes_tables);
    write("binary.toml", std::string("\0\1\2", 3));
    EXPECT_NE(
        complaint_about(job_head + "rig = \"binary.toml\"\n" + axes_tables).find("can't be read as a rig"),
        std::string::npos);
    EXPECT_NE(complaint_about(job_head + "rig = \"rigs\"\n" + axes_tables).find("this is a folder"),
              std::string::npos);
    EXPECT_NE(
        complaint_about(job_head + "rig = 3\n" + axes_tables).find("rig = 3 is an integer; it must be text"),
        std::string::npos);
    EXPECT_NE(complaint_about(job_head + "rig = \"\"\n" + axes_tables).find("is no name of a file"),
              std::string::npos);
}

TEST_F(RigFiles, ATextThatIsNoFileNamesNone) {
    EXPECT_THROW((void)read_job_text(job_head + "rig = \"rigs/mine.toml\"\n" + axes_tables, "job"), JobFaults);
}

TEST_F(RigFiles, EachValueTellsWhereItCameFrom) {
    write("rigs/mine.toml", hammer_table + cart_table + contact_table);
    write("job.toml", job_head + "rig = \"rigs/mine.toml\"\n[cart]\namplitude_m = 2e-3\n" + axes_tables);
    const std::vector<std::string> overrides{"contact.damping_ns_per_m=7"};
    const auto [job, origins] = read_job_with_origins(folder_ / "job.toml", overrides);
    EXPECT_EQ(origins.at("hammer.mass_kg"), (folder_ / "rigs/mine.toml").string() + ":2");
    EXPECT_EQ(origins.at("cart.amplitude_m"), "line 5");
    EXPECT_EQ(origins.at("contact.damping_ns_per_m"), "--set 1");
    const std::string text = resolved_text(job, origins);
    EXPECT_NE(text.find("amplitude A0 of the cart, y = A0 sin(Omega t) [m] (line 5)"), std::string::npos);
    EXPECT_NE(text.find("budget of a cell [forcing cycles] (default)"), std::string::npos);
    EXPECT_EQ(read_job_text(text, "resolved"), job);
}

}  // namespace
}  // namespace peterka::job
