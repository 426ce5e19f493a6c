// Memory left by control groups according to their files, in
// folders that mimic those of containers and batch systems.
#include "run/memory_left.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace peterka {
namespace {

constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();

class ControlGroups : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::remove_all(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& file, const std::string& text) const {
        const auto path = folder_ / file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    void mount(const std::string& root, const std::string& type, const std::string& options) const {
        std::ofstream lines(folder_ / "proc/mountinfo", std::ios::app);
        lines << "23 1 0:20 / /proc rw,relatime - proc proc rw\n"
              << "36 31 0:33 " << root << " " << (folder_ / "group").string() << " ro,nosuid shared:9 - "
              << type << " " << type << " rw," << options << "\n";
    }
    [[nodiscard]] std::int64_t left() const { return left_in_control_groups(folder_ / "proc"); }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("peterka_control_groups_" + std::to_string(getpid()));
};

TEST_F(ControlGroups, TheTightestOfAGroupAndThoseAboveItCounts) {
    write("proc/cgroup", "0::/job_7/step_0/task_1\n");
    mount("/", "cgroup2", "nsdelegate");
    write("group/job_7/memory.max", "1000000000\n");
    write("group/job_7/memory.current", "300000000\n");
    write("group/job_7/memory.stat", "anon 200000000\ninactive_file 50000000\nactive_file 1\n");
    write("group/job_7/step_0/memory.max", "2000000000\n");
    write("group/job_7/step_0/memory.current", "300000000\n");
    write("group/job_7/step_0/task_1/memory.max", "max\n");
    write("group/job_7/step_0/task_1/memory.current", "10000000\n");
    EXPECT_EQ(left(), 750000000);  // unused file cache counts as free
    write("group/job_7/step_0/memory.max", "400000000\n");
    EXPECT_EQ(left(), 100000000);
    write("group/job_7/step_0/memory.max", "200000000\n");
    EXPECT_EQ(left(), 0);
}

TEST_F(ControlGroups, AContainerSeesItsOwnGroupAsTheRoot) {
    write("proc/cgroup", "0::/\n");
    mount("/", "cgroup2", "nsdelegate");
    write("group/memory.max", "500000000\n");
    write("group/memory.current", "100000000\n");
    EXPECT_EQ(left(), 400000000);
}

TEST_F(ControlGroups, ThoseOfVersionOneHaveTheirLimitUnderAnotherName) {
    write("proc/cgroup", "9:cpu:/elsewhere\n4:hugetlb,memory:/docker/abc/job\n0::/\n");
    mount("/docker/abc", "cgroup", "memory,hugetlb");
    write("group/memory.limit_in_bytes", "9223372036854771712\n");
    write("group/memory.usage_in_bytes", "700000000\n");
    write("group/job/memory.limit_in_bytes", "800000000\n");
    write("group/job/memory.usage_in_bytes", "700000000\n");
    write("group/job/memory.stat", "inactive_file 1\ntotal_inactive_file 300000000\n");
    EXPECT_EQ(left(), 400000000);
}

TEST_F(ControlGroups, OtherControllersAndSystemsWithoutThemSetNoLimit) {
    write("proc/cgroup", "4:cpu:/job\n");
    mount("/", "cgroup", "cpu");
    write("group/job/memory.limit_in_bytes", "1\n");
    write("group/job/memory.usage_in_bytes", "0\n");
    EXPECT_EQ(left(), no_limit);
    EXPECT_EQ(left_in_control_groups(folder_ / "nothing"), no_limit);
}

}  // namespace
}  // namespace peterka
