#include "support/terminal.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace peterka {
namespace {

// Open MPI 4's is orterun, or a link to it; that of 5 becomes PRRTE's.
bool is_launcher(const std::string& program) {
    return program.starts_with("mpirun") || program.starts_with("orterun") || program.starts_with("prterun");
}

// The terminal to which mpirun on this machine, our parent, hands our stderr on; a daemon on another machine
// has none.
std::optional<std::string> terminal_of_mpirun() {
    if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) return std::nullopt;
    std::error_code unreadable;
    const auto launcher = "/proc/" + std::to_string(getppid());
    const auto name = std::filesystem::read_symlink(launcher + "/exe", unreadable).filename().string();
    if (unreadable || !is_launcher(name)) return std::nullopt;
    const auto target = std::filesystem::read_symlink(launcher + "/fd/2", unreadable).string();
    if (unreadable || !target.starts_with("/dev/pts/")) return std::nullopt;
    return target;
}

int columns_of(int terminal) {
    constexpr int usual = 80;
    winsize size{};
    return ioctl(terminal, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

bool stderr_is_watched() {
    return isatty(STDERR_FILENO) != 0 || terminal_of_mpirun().has_value();
}

int stderr_columns() {
    const auto elsewhere = isatty(STDERR_FILENO) != 0 ? std::nullopt : terminal_of_mpirun();
    const int opened = elsewhere ? open(elsewhere->c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC) : -1;
    const int columns = columns_of(opened < 0 ? STDERR_FILENO : opened);
    if (opened >= 0) close(opened);
    return columns;
}

}  // namespace peterka
