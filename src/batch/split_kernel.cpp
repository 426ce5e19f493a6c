// The kernel with a cubic spring, separate from the other so that both compile in parallel.
#include "batch/targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/split_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include "batch/cycle_kernel.hpp"
#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_ATTR void run_split(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    run_kernel<Law::kicks>(rig, grid, lanes, queues, wanted);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run_split);

void run_split_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    HWY_DYNAMIC_DISPATCH(run_split)(rig, grid, lanes, queues, wanted);
}

}  // namespace peterka::batch
#endif
