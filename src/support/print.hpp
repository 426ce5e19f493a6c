// What a command was asked to print, on stdout: if it cannot be written, the command has failed.
#pragma once

#include <string>
#include <string_view>

namespace peterka {

// Throws Failure(ExitCode::output) with the reason, and with what becomes of the work, if that is said.
void print(const std::string& text, std::string_view nevertheless = "");

// To be called before anything else: where stdin, stdout or stderr is closed, a file that is opened later would
// get its place, and what is printed. There writing fails from now on as it would without it.
void occupy_closed_streams();

}  // namespace peterka
