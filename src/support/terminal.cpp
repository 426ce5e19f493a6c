#include "support/terminal.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace peterka {
namespace {

// Open MPI 4's is orterun, or a link to it; that of 5 becomes PRRTE's prterun, in Debian 13 a link to prte.
bool is_launcher(const std::string& program) {
    return program.starts_with("mpirun") || program.starts_with("orterun") || program == "prterun" ||
           program == "prte";
}

// The terminal of mpirun on this machine, our parent; a daemon on another machine has none.
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

}  // namespace

std::optional<Terminal> Terminal::of_stderr() {
    if (isatty(STDERR_FILENO) != 0) return Terminal(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0));
    const auto elsewhere = terminal_of_mpirun();
    if (!elsewhere) return std::nullopt;
    // A stopped terminal does not stop the run.
    const int opened = open(elsewhere->c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (opened < 0) return std::nullopt;
    return Terminal(opened);
}

Terminal::~Terminal() {
    if (descriptor_ >= 0) close(descriptor_);
}

int Terminal::columns() const {
    constexpr int usual = 80;
    winsize size{};
    return ioctl(descriptor_, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

void Terminal::write(std::string_view text) const {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor_, text.data(), text.size());
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace peterka
