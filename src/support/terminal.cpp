#include "support/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace peterka {

bool stderr_is_watched() {
    if (isatty(STDERR_FILENO) != 0) return true;
    if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) return false;

    // Started by Open MPI: the parent is mpirun itself, or a daemon without a terminal on another machine.
    std::error_code unreadable;
    const auto launcher = "/proc/" + std::to_string(getppid());
    const auto name = std::filesystem::read_symlink(launcher + "/exe", unreadable).filename().string();
    if (unreadable || !(name.starts_with("mpirun") || name.starts_with("orterun"))) return false;
    const auto target = std::filesystem::read_symlink(launcher + "/fd/2", unreadable).string();
    return !unreadable && target.starts_with("/dev/pts/");
}

}  // namespace peterka
