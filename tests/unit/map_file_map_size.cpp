// The size of a file is known before it is created, and a file that does not fit is not begun.
#include "map_file/map_size.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <string>

#include "map_examples.hpp"
#include "map_file/make_file.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {
namespace {

using examples::Folder;

void expect_exact(const job::Job& job) {
    const Folder folder;
    make_file(folder / "map.h5", job, examples::made_by());
    EXPECT_EQ(predicted_bytes(job, examples::made_by()),
              static_cast<std::int64_t>(std::filesystem::file_size(folder / "map.h5")));
}

TEST(OutputMapSize, PredictsTheFileToTheByte) {
    for (const auto& [rows, columns] : {std::pair{4, 4}, {2, 300}, {300, 2}, {16, 16}, {17, 33}, {100, 70}}) {
        SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
        expect_exact(examples::small_map(rows, columns));
        expect_exact(examples::small_basin(rows, columns));
    }
}

TEST(OutputMapSize, PredictsExtraFieldsAndLongTitlesToTheByte) {
    job::Job job = examples::small_map(40, 50);
    job.output.fields = {job::OptionalField::lyapunov, job::OptionalField::orbit};
    expect_exact(job);
    job.title = std::string(3000, 'x');
    expect_exact(job);
    job.title = "";
    expect_exact(job);
}

// A branch is one chunk, whose sides take more header bytes the larger they are.
TEST(OutputMapSize, PredictsSweepsToTheByte) {
    for (const auto& [points, samples] :
         {std::pair{3, 1}, {3, 300}, {255, 64}, {256, 1}, {601, 64}, {601, 300}, {70'000, 1}}) {
        SCOPED_TRACE(std::to_string(points) + " points, " + std::to_string(samples) + " samples");
        job::Job job = examples::small_map(1, points);
        job.kind = job::Kind::sweep;
        job.sweep.gap_ratio = {1.5, 2.5};
        job.sweep.samples = samples;
        expect_exact(job);
        job.starts.count = 8;
        job.starts.attractors = 8;
        expect_exact(job);
    }
}

TEST(OutputMapSize, HugeGridsDoNotOverflow) {
    EXPECT_GT(predicted_bytes(examples::small_map(512, 1'000'000'000)), 15'000'000'000'000);
    for (const std::int64_t points :
         {std::int64_t{1'000'000'000},
          std::int64_t{std::numeric_limits<std::int32_t>::max()}}) {  // too many in all fields, and in one
        EXPECT_EQ(predicted_bytes(examples::small_map(points, points)),
                  std::numeric_limits<std::int64_t>::max());
    }
}

TEST(OutputMapSize, TooLargeIsRefusedWithBothNumbers) {
    const Folder folder;
    constexpr std::int64_t wanted = 4'000'000'000'000'000'000;
    try {
        require_space(folder / "map.h5", wanted);
        FAIL() << "was not refused";
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        EXPECT_EQ(failure.code(), ExitCode::output);
        EXPECT_NE(text.find("4000000000000000000 bytes"), std::string::npos) << text;
        EXPECT_NE(text.find(" left ("), std::string::npos) << text;
    }
    EXPECT_NO_THROW(require_space(folder / "map.h5", 1000));
}

TEST(OutputMapSize, MissingFolderIsRefused) {
    const Folder folder;
    try {
        make_file(folder / "nowhere" / "map.h5", examples::small_map(4, 4), examples::made_by());
        FAIL() << "was not refused";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::output);
        EXPECT_NE(std::string(failure.what()).find("No such file or directory"), std::string::npos);
    }
}

// A limit on the size of files, for the lifetime of this object.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(OutputMapSize, WhatTheSystemRefusesLeavesNothingBehind) {
    const Folder folder;
    {
        const FileSizeLimit limit(100'000);
        try {
            make_file(folder / "map.h5", examples::small_map(100, 100), examples::made_by());
            FAIL() << "was not refused";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::output);
            EXPECT_NE(std::string(failure.what()).find("File too large"), std::string::npos) << failure.what();
        }
    }
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace peterka::map_file
