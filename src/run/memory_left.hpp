// How much memory is left, and what limits it: the machine, the control group of a container or of a batch
// system (Linux cgroups), or a limit of the process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>

namespace peterka {

enum class MemoryLimit : std::int32_t { machine, control_group, process };

struct MemoryLeft {
    std::int64_t bytes = std::numeric_limits<std::int64_t>::max();  // no limit
    MemoryLimit by = MemoryLimit::machine;
};

// Available to all processes of this machine, or of this process's control group, together.
[[nodiscard]] MemoryLeft memory_left_to_all();

// Available to this process alone (ulimit -v, -d), beyond what it has.
[[nodiscard]] MemoryLeft memory_left_to_one();

// Memory left by the control groups of a process, version 1 or 2, and by their visible ancestors. Unused file
// pages count as left. process: its folder in /proc.
[[nodiscard]] std::int64_t left_in_control_groups(const std::filesystem::path& process);

// Resident memory of this process [bytes].
[[nodiscard]] std::int64_t resident_bytes();

}  // namespace peterka
