// What a function expects of whoever calls it, as code at its door.
//
//     PETERKA_EXPECT(slot < size_);
//
// Where it doesn't hold, one part of the program broke its word to another one: std::logic_error, on which the
// program ends with ExitCode::internal. What users, files and disks may do wrong is no such thing (errors.hpp).
// Looked at in builds with tests or sanitizers, which define PETERKA_EXPECTS; elsewhere it costs nothing, for
// the condition is compiled and never evaluated.
#pragma once

#ifdef PETERKA_EXPECTS

#include <stdexcept>
#include <string>

namespace peterka {

[[noreturn]] inline void broken_expectation(const char* condition, const char* file, int line) {
    throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": expected " + condition);
}

}  // namespace peterka

#define PETERKA_EXPECT(condition) \
    ((condition) ? static_cast<void>(0) : ::peterka::broken_expectation(#condition, __FILE__, __LINE__))

#else

#define PETERKA_EXPECT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))

#endif
