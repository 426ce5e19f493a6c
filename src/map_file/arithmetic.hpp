// What the last bits of a cell depend on besides its job: the instruction set and the C library's functions.
#pragma once

#include <string>

namespace peterka::map_file {

// The arithmetic of this process, e.g. "x86-64, libm 3f09c2a1, vectors fma". The number is a hash of what the C
// library's functions return for many arguments: releases and processors with equal results share it.
[[nodiscard]] std::string arithmetic();

}  // namespace peterka::map_file
