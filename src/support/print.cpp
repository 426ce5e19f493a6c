#include "support/print.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "support/errors.hpp"
#include "support/escape_untrusted.hpp"

namespace peterka {

void print(const std::string& text, std::string_view nevertheless) {
    const std::string shown = escape_untrusted_page(text);
    errno = 0;
    const bool written = std::fwrite(shown.data(), 1, shown.size(), stdout) == shown.size();
    if (written && std::fflush(stdout) == 0) return;
    throw Failure(ExitCode::output, fmt::format("standard output cannot be written: {}{}{}",
                                                std::generic_category().message(errno),
                                                nevertheless.empty() ? "" : ". ", nevertheless));
}

void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
        // takes the lowest free descriptor, which is this one; read-only, so that writing fails
        static_cast<void>(::open("/dev/null", O_RDONLY));
    }
}

}  // namespace peterka
