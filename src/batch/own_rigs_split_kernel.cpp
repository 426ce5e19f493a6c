// The kernel for lanes with their own rigs and cubic springs, separate so that both compile in parallel.
#define PETERKA_WITHOUT_SSE4
#include "batch/targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/own_rigs_split_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include "batch/cycle_kernel.hpp"
#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_ATTR void run_own_rigs_split(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    run_own_kernel<Law::kicks>(grid, lanes, queues, wanted);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run_own_rigs_split);

void run_own_rigs_split_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    HWY_DYNAMIC_DISPATCH(run_own_rigs_split)(grid, lanes, queues, wanted);
}

}  // namespace peterka::batch
#endif
