#include "run/memory_left.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace peterka {
namespace {

constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();

// Of a process [bytes].
struct Taken {
    std::int64_t address_space = 0;
    std::int64_t resident = 0;
};

Taken taken() {
    Taken pages;
    std::ifstream("/proc/self/statm") >> pages.address_space >> pages.resident;
    const std::int64_t page = sysconf(_SC_PAGESIZE);
    return {pages.address_space * page, pages.resident * page};
}

// The number that follows a name in a file of such pairs.
std::optional<std::int64_t> number_after(const std::filesystem::path& file, std::string_view wanted) {
    std::ifstream pairs(file);
    for (std::string name; pairs >> name;) {
        std::int64_t number = 0;
        if (name == wanted && pairs >> number) return number;
    }
    return std::nullopt;
}

// From /proc/meminfo; no limit if it has no entry.
std::int64_t available_in_machine() {
    const auto kilobytes = number_after("/proc/meminfo", "MemAvailable:");
    return kilobytes ? *kilobytes * 1024 : no_limit;
}

std::int64_t left_below(int limit_of, std::int64_t taken) {
    rlimit limit{};
    if (getrlimit(static_cast<__rlimit_resource_t>(limit_of), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return no_limit;
    return std::max<std::int64_t>(static_cast<std::int64_t>(limit.rlim_cur) - taken, 0);
}

// Names of a control group's files.
struct GroupFiles {
    const char* limit;
    const char* used;
    const char* unused_pages;  // in memory.stat
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file"};

std::optional<std::int64_t> number_in(const std::filesystem::path& file) {
    std::int64_t number = 0;
    if (std::ifstream(file) >> number) return number;  // `max` means no limit
    return std::nullopt;
}

std::int64_t left_in_group(const std::filesystem::path& folder, const GroupFiles& files) {
    const auto limit = number_in(folder / files.limit);
    const auto used = number_in(folder / files.used);
    if (!limit || !used) return no_limit;
    const std::int64_t unused = number_after(folder / "memory.stat", files.unused_pages).value_or(0);
    return std::max<std::int64_t>(*limit - (*used - std::min(unused, *used)), 0);
}

// Where control groups are mounted: a line of /proc/PID/mountinfo, "ID PARENT DEVICE ROOT POINT OPTIONS ... -
// TYPE SOURCE OPTIONS".
struct Mount {
    std::string root;
    std::filesystem::path point;
    bool limits_memory = false;
    GroupFiles files = version_2;
};

std::optional<Mount> mount_of(const std::string& line) {
    Mount mount;
    std::istringstream words(line);
    std::string word;
    words >> word >> word >> word >> mount.root >> mount.point;
    while (words >> word && word != "-") {
    }
    std::string type;
    std::string options;
    words >> type >> word >> options;
    if (type != "cgroup" && type != "cgroup2") return std::nullopt;
    if (type == "cgroup") mount.files = version_1;
    mount.limits_memory = type == "cgroup2" || ("," + options + ",").find(",memory,") != std::string::npos;
    return mount;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

// The path of the group under this mount, from a line of /proc/PID/cgroup, "NUMBER:CONTROLLERS:PATH".
std::optional<std::string> path_under(const Mount& mount, const std::string& line) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) return std::nullopt;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const bool is_of_version_1 = mount.files.limit == version_1.limit;
    if (controllers.find(is_of_version_1 ? ",memory," : ",,") == std::string::npos) return std::nullopt;
    std::string path = line.substr(second + 1);
    if (mount.root == "/") return path;
    // a container may see its own group as the root
    return path.starts_with(mount.root) ? path.substr(mount.root.size()) : "";
}

}  // namespace

std::int64_t left_in_control_groups(const std::filesystem::path& process) {
    std::int64_t left = no_limit;
    const std::vector<std::string> groups = lines_of(process / "cgroup");
    for (const std::string& line : lines_of(process / "mountinfo")) {
        const auto mount = mount_of(line);
        if (!mount || !mount->limits_memory) continue;
        for (const std::string& group : groups) {
            const auto path = path_under(*mount, group);
            if (!path || path->find("..") != std::string::npos) continue;
            std::filesystem::path folder = mount->point;
            left = std::min(left, left_in_group(folder, mount->files));
            for (const auto& part : std::filesystem::path(*path).relative_path()) {
                folder /= part;
                left = std::min(left, left_in_group(folder, mount->files));
            }
        }
    }
    return left;
}

MemoryLeft memory_left_to_all() {
    const MemoryLeft machine{available_in_machine(), MemoryLimit::machine};
    const MemoryLeft group{left_in_control_groups("/proc/self"), MemoryLimit::control_group};
    return group.bytes < machine.bytes ? group : machine;
}

MemoryLeft memory_left_to_one() {
    const Taken so_far = taken();
    return {std::min(left_below(RLIMIT_AS, so_far.address_space), left_below(RLIMIT_DATA, so_far.resident)),
            MemoryLimit::process};
}

std::int64_t resident_bytes() {
    return taken().resident;
}

}  // namespace peterka
