// Every rule of the job checker: tests/job/bad holds one job per rule and, beside it, the full message.
//
// Lines "#! --set key=value" of such a job are overrides.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "job/choose.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job_examples.hpp"

namespace peterka::job {
namespace {

std::vector<std::filesystem::path> bad_jobs() {
    std::vector<std::filesystem::path> jobs;
    for (const auto& entry : std::filesystem::directory_iterator(examples::source_folder() / "tests/job/bad")) {
        if (entry.path().extension() == ".toml") jobs.push_back(entry.path());
    }
    std::sort(jobs.begin(), jobs.end());
    return jobs;
}

std::vector<std::string> overrides_in(const std::string& text) {
    const std::string mark = "#! --set ";
    std::vector<std::string> overrides;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(mark)) overrides.push_back(line.substr(mark.size()));
    }
    return overrides;
}

void replace(std::string& text, const std::string& mark, const std::string& words) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + words.size())) {
        text.replace(at, mark.size(), words);
    }
}

// The message, where {quoted fields} and {quoted laws} stand for all names accepted by [output] fields and
// contact.law, {fields} for those fields as a plain list, with elasticities by one number in a word.
std::string message_in(const std::filesystem::path& path) {
    std::vector<std::string_view> of_cells;
    for (const auto& field : Names<OptionalField>::all) {
        if (field.name.find("_elasticity_") == field.name.npos) of_cells.push_back(field.name);
    }
    std::string text = examples::content_of(path);
    replace(text, "{fields}",
            fmt::format("{}; of one number alone force_elasticity_KEY, as in force_elasticity_gap_m",
                        fmt::join(of_cells, ", ")));
    replace(text, "{quoted fields}", quoted_list(all_names<OptionalField>()));
    replace(text, "{quoted laws}", quoted_list(all_names<ContactLaw>()));
    return text;
}

class BadJob : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(BadJob, GetsItsMessage) {
    const std::string text = examples::content_of(GetParam());
    auto expected_file = GetParam();
    const std::string expected = message_in(expected_file.replace_extension(".txt"));
    ASSERT_FALSE(expected.empty()) << "no expected message in " << expected_file;
    try {
        (void)read_job_text(text, GetParam().filename().string(), overrides_in(text));
        FAIL() << "the job was accepted";
    } catch (const JobFaults& faults) {
        EXPECT_EQ(faults.what() + std::string("\n"), expected);
        EXPECT_EQ(faults.code(), ExitCode::bad_job);
        EXPECT_EQ(faults.count(), static_cast<std::size_t>(std::count(expected.begin(), expected.end(), '\n')));
    }
}

INSTANTIATE_TEST_SUITE_P(JobFaults, BadJob, testing::ValuesIn(bad_jobs()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

TEST(JobFaults, TheFolderOfBadJobsIsNotEmpty) {
    EXPECT_GT(bad_jobs().size(), 100U);
}

TEST(JobFaults, EveryMessageSaysWhatWhyAndWhatToDo) {
    for (auto path : bad_jobs()) {
        std::istringstream lines(examples::content_of(path.replace_extension(".txt")));
        for (std::string line; std::getline(lines, line);) {
            EXPECT_GE(std::count(line.begin(), line.end(), ';'), 2) << path << ": " << line;
        }
    }
}

}  // namespace
}  // namespace peterka::job
