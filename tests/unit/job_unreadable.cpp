// Input that is not a job gives a clear fault: never a crash, a hang or a guess.
#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

#include "job/read.hpp"
#include "job/write.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

std::string complaint_about(const std::filesystem::path& path) {
    try {
        (void)read_job_file(path);
    } catch (const JobFaults& faults) {
        return faults.what();
    }
    return "accepted";
}

std::string complaint_about_text(std::string_view text, std::vector<std::string> overrides = {}) {
    try {
        (void)read_job_text(text, "job.toml", overrides);
    } catch (const JobFaults& faults) {
        return faults.what();
    }
    return "accepted";
}

class UnreadableJob : public testing::Test {
  protected:
    UnreadableJob()
        : folder_(std::filesystem::temp_directory_path() / ("peterka-job-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~UnreadableJob() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path written(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    std::filesystem::path folder_;
};

TEST_F(UnreadableJob, MissingFile) {
    const auto path = folder_ / "nowhere.toml";
    EXPECT_EQ(complaint_about(path),
              path.string() + ": there is no such file; a job is read from a TOML file; check the path");
}

TEST_F(UnreadableJob, Folder) {
    EXPECT_EQ(complaint_about(folder_),
              folder_.string() + ": this is a folder; a job is one TOML file; name the file inside it");
}

// A file whose first byte the system refuses to read, for its address is no one's.
TEST_F(UnreadableJob, AFileThatCannotBeRead) {
    EXPECT_EQ(complaint_about("/proc/self/mem"),
              "/proc/self/mem: cannot be read; the system says: Input/output error; check its permissions");
}

TEST_F(UnreadableJob, PathThroughAFile) {
    const auto path = written("file", "x") / "job.toml";
    EXPECT_EQ(complaint_about(path),
              path.string() + ": there is no such file; a job is read from a TOML file; check the path");
}

TEST_F(UnreadableJob, Device) {
    EXPECT_EQ(
        complaint_about("/dev/zero"),
        "/dev/zero: this is a pipe, socket or device; a job is read from a regular file, by several processes "
        "if need be; save it as a file");
}

TEST_F(UnreadableJob, EmptyFile) {
    const auto path = written("empty.toml", "");
    EXPECT_EQ(complaint_about(path), path.string() +
                                         ": is empty; a job names at least its kind, hammer, cart, contact and "
                                         "axes; start from a copy of jobs/smoke.toml");
}

TEST_F(UnreadableJob, OverLargeFile) {
    const auto path = written("large.toml", std::string(1024 * 1024 + 1, '\n'));
    EXPECT_EQ(complaint_about(path),
              path.string() +
                  ": is larger than 1 MiB; a job is a page of text; check that this is the "
                  "job and not its output");
    const auto just_fits = written("fits.toml", std::string(1024 * 1024, '\n'));
    EXPECT_NE(complaint_about(just_fits).find("schema is missing"), std::string::npos);
}

TEST_F(UnreadableJob, NulByte) {
    EXPECT_EQ(
        complaint_about_text(std::string_view("schema = 1\nki\0nd", 17)),
        "job.toml:2:3: a NUL byte; a job is text and this is binary; check that this is the job and not its "
        "output");
}

TEST_F(UnreadableJob, OverLongLineAndDeepNesting) {
    std::string deep = "schema = 1\na";
    for (int i = 0; i < 500'000; ++i) deep += ".a";
    EXPECT_EQ(
        complaint_about_text(deep + " = 1\n"),
        "job.toml:2:1: a line of 1000005 bytes; no line of a job is longer than 4096; check that this is the "
        "job, or break the line");
    EXPECT_NE(complaint_about_text(std::string(3000, '[')).find("TOML syntax"), std::string::npos);
    EXPECT_NE(
        complaint_about_text("schema = 1\n", {"a=" + std::string(5000, '[')}).find("--set 1: the value is"),
        std::string::npos);
}

TEST_F(UnreadableJob, TextThatIsNotUtf8) {
    EXPECT_EQ(complaint_about_text("schema = 1\ntitle = \"caf\xe9\"\n"),
              "job.toml:2:12: TOML syntax, encountered invalid utf-8 sequence; nothing behind this place can "
              "be read; "
              "mend this line, then check the job again");
    EXPECT_NE(complaint_about_text("schema = 1\n", {"title=caf\xe9"})
                  .find("--set 1: the value is not UTF-8; a job is UTF-8 text; write the value in UTF-8"),
              std::string::npos);
}

TEST_F(UnreadableJob, BinaryRubbishIsRefusedWhateverItIs) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 2000; ++i) {
        std::string rubbish(1 + random() % 300, ' ');
        for (char& c : rubbish) c = static_cast<char>(random());
        EXPECT_NE(complaint_about_text(rubbish), "accepted");
    }
}

// A shipped job with one byte changed is a job or a fault, and never anything else.
TEST_F(UnreadableJob, OneWrongByteNeverCrashes) {
    const std::string good = resolved_text(read_job_file(examples::source_folder() / "jobs/smoke.toml"));
    std::mt19937_64 random(2);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        text[random() % text.size()] = static_cast<char>(random());
        refused += complaint_about_text(text) == "accepted" ? 0 : 1;
    }
    EXPECT_GT(refused, 1000);
    EXPECT_LT(refused, 3000);
}

}  // namespace
}  // namespace peterka::job
