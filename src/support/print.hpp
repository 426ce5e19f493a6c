// What a command was asked to print, on stdout: if it cannot be written, the command has failed.
#pragma once

#include <string>
#include <string_view>

namespace peterka {

// Throws Failure(ExitCode::output) with the reason, and with what becomes of the work (`nevertheless`), if
// given.
void print(const std::string& text, std::string_view nevertheless = "");

// To be called before anything else: if stdin, stdout or stderr is closed, a file opened later would get its
// descriptor, and what is printed. Writing there still fails, as to a closed stream.
void occupy_closed_streams();

}  // namespace peterka
