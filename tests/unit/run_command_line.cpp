// Interpretation of the command line.
#include "run/command_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

#include "run/run_plan.hpp"
#include "support/errors.hpp"

namespace peterka {
namespace {

Request read(std::initializer_list<const char*> arguments) {
    std::vector<const char*> argv{"peterka"};
    argv.insert(argv.end(), arguments);
    return read_command_line(static_cast<int>(argv.size()), argv.data());
}

void expect_refused(std::initializer_list<const char*> arguments, const std::string& because) {
    try {
        (void)read(arguments);
        FAIL() << "accepted; expected: " << because;
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_job);
        EXPECT_NE(std::string(failure.what()).find(because), std::string::npos) << failure.what();
        EXPECT_NE(std::string(failure.what()).find("--help"), std::string::npos) << failure.what();
    }
}

TEST(CommandLine, RunHasItsDefaults) {
    const Request request = read({"run", "jobs/smoke.toml"});
    EXPECT_EQ(request.command, Command::run);
    EXPECT_EQ(request.job_file, "jobs/smoke.toml");
    EXPECT_FALSE(request.fresh);
    EXPECT_FALSE(request.quiet);
    EXPECT_TRUE(std::isinf(request.max_wall_seconds));
    EXPECT_EQ(map_file_of(request), "smoke.h5");
}

TEST(CommandLine, RunTakesEveryOption) {
    const Request request =
        read({"run", "a.toml", "--output", "there/b.h5", "--fresh", "--quiet", "--max-wall", "1.5"});
    EXPECT_TRUE(request.fresh);
    EXPECT_TRUE(request.quiet);
    EXPECT_EQ(request.max_wall_seconds, 1.5);
    EXPECT_EQ(map_file_of(request), "there/b.h5");
}

TEST(CommandLine, OverridesMayStandAnywhereAndRepeat) {
    const Request request = read({"check", "--set", "hammer.mass_kg=1", "a.toml", "--set", "start.x=-2"});
    EXPECT_EQ(request.command, Command::check);
    EXPECT_EQ(request.job_file, "a.toml");
    EXPECT_EQ(request.overrides, (std::vector<std::string>{"hammer.mass_kg=1", "start.x=-2"}));
}

TEST(CommandLine, HelpTeaches) {
    const Request request = read({"--help"});
    EXPECT_EQ(request.command, Command::print);
    for (const char* word : {"mpirun", "Exit codes", "resumes", "README.md", "check", "--version"}) {
        EXPECT_NE(request.text.find(word), std::string::npos) << word;
    }
}

TEST(CommandLine, HelpOfACommandNamesItsOptions) {
    const std::string help = read({"run", "--help"}).text;
    for (const char* option : {"--output", "--set", "--fresh", "--max-wall", "--quiet"}) {
        EXPECT_NE(help.find(option), std::string::npos) << option;
    }
}

TEST(CommandLine, WhatCannotBeUnderstoodIsRefused) {
    expect_refused({}, "run or check");
    expect_refused({"run"}, "JOB");
    expect_refused({"compute", "a.toml"}, "compute");
    expect_refused({"run", "a.toml", "b.toml"}, "b.toml");
    expect_refused({"run", "a.toml", "--verbose"}, "--verbose");
    expect_refused({"run", "a.toml", "--output"}, "--output");
    expect_refused({"check", "a.toml", "--fresh"}, "--fresh");
}

TEST(CommandLine, ATimeLimitIsAPositiveNumber) {
    for (const char* seconds : {"0", "-5", "nan", "soon", "5s"}) {
        expect_refused({"run", "a.toml", "--max-wall", seconds}, "positive number of seconds");
    }
}

}  // namespace
}  // namespace peterka
