// What a command was asked to print, on stdout: if it cannot be written, the command has failed.
#pragma once

#include <cstdio>
#include <string>

#include "support/errors.hpp"

namespace peterka {

// Throws Failure(ExitCode::output).
inline void print(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) {
        throw Failure(ExitCode::output, "standard output cannot be written; is its disk full?");
    }
}

}  // namespace peterka
