// Instruction sets for which the kernels are built besides the compiler's baseline: SSE4, AVX2 and AVX-512 on
// x86. More, and each release of Highway adds some, would only lengthen the build. On aarch64 NEON alone,
// whatever the baseline: a vector of SVE has no size that the compiler knows, and can't be part of a struct,
// such as Pair. Nor are there instruction sets to choose from at run time there, which Highway knows by the
// name of a missing header; otherwise it would compile NEON's vectors with instructions for cryptography, and
// GCC couldn't inline them into what a struct of vectors is made by.
#pragma once

#if defined(__aarch64__)
#undef TOOLCHAIN_MISS_SYS_AUXV_H
#define TOOLCHAIN_MISS_SYS_AUXV_H
#endif
#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#define PETERKA_ALL_OF_X86 ((2LL << HWY_HIGHEST_TARGET_BIT_X86) - 1)
#define PETERKA_ALL_OF_SVE (HWY_SVE | HWY_SVE_256 | HWY_SVE2 | HWY_SVE2_128)
#define PETERKA_CHOSEN_OF_X86 (HWY_BASELINE_TARGETS | HWY_SSE4 | HWY_AVX2 | HWY_AVX3)
#define HWY_DISABLED_TARGETS ((PETERKA_ALL_OF_X86 & ~PETERKA_CHOSEN_OF_X86) | PETERKA_ALL_OF_SVE)
