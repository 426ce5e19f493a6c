// Instruction sets that the kernels are built for, besides the compiler's baseline: SSE4, AVX2 and AVX-512 on
// x86. More would only lengthen the build, and so would SSE4 for lanes with rigs of their own
// (PETERKA_WITHOUT_SSE4): the baseline does the same there.
#pragma once

#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#if defined(HWY_AVX3_ZEN4)
#define PETERKA_NEVER (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3_ZEN4)
#else
#define PETERKA_NEVER (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#if defined(PETERKA_WITHOUT_SSE4)
#define HWY_DISABLED_TARGETS (PETERKA_NEVER | HWY_SSE4)
#else
#define HWY_DISABLED_TARGETS PETERKA_NEVER
#endif
