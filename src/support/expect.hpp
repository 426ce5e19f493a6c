// Preconditions of a function, checked on entry.
//
//     PETERKA_EXPECT(slot < size_);
//
// A violation is a bug: std::logic_error, on which the program ends with ExitCode::internal. Errors of users,
// files and disks are not of this kind (errors.hpp). Checked in builds with tests or sanitizers, which define
// PETERKA_EXPECTS; elsewhere it costs nothing, as the condition is compiled but never evaluated.
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
