// The kernel with a cubic spring, separate from the others so that all compile in parallel.
#include "batch/targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/split_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include "batch/cycle_kernel.hpp"
#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_ATTR void run_split(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    Kernel<Law::kicks, false>(rig, grid, lanes, queues).run(whole);
}
HWY_ATTR void run_own_rigs_split(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    Kernel<Law::kicks, true>(grid, lanes, queues).run(whole);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run_split);
HWY_EXPORT(run_own_rigs_split);

void run_split_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    HWY_DYNAMIC_DISPATCH(run_split)(rig, grid, lanes, queues, whole);
}
void run_own_rigs_split_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    HWY_DYNAMIC_DISPATCH(run_own_rigs_split)(grid, lanes, queues, whole);
}

}  // namespace peterka::batch
#endif
