// The kernel for lanes with their own rigs: see kernel-inl.hpp.
#define PETERKA_WITHOUT_SSE4
#include "batch/targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/own_rigs_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include "batch/cycle_kernel.hpp"
#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_ATTR void run_own_rigs(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    run_own_kernel<Law::spring_dashpot>(grid, lanes, queues, wanted);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run_own_rigs);

void run_own_rigs_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    HWY_DYNAMIC_DISPATCH(run_own_rigs)(grid, lanes, queues, wanted);
}

}  // namespace peterka::batch
#endif
