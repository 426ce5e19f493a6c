// The kernel without a cubic spring for each instruction set, dispatched at run time.
#include "batch/targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/cycle_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include "batch/cycle_kernel.hpp"
#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_ATTR void run_linear(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    Kernel<Law::spring_dashpot, false>(rig, grid, lanes, queues).run(whole);
}
HWY_ATTR void run_own_rigs(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    Kernel<Law::spring_dashpot, true>(grid, lanes, queues).run(whole);
}

const char* arithmetic_name() {
#if HWY_NATIVE_FMA
    return "fma";
#else
    return "plain";
#endif
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run_linear);
HWY_EXPORT(run_own_rigs);
HWY_EXPORT(arithmetic_name);

void run_linear_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    HWY_DYNAMIC_DISPATCH(run_linear)(rig, grid, lanes, queues, whole);
}
void run_own_rigs_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole) {
    HWY_DYNAMIC_DISPATCH(run_own_rigs)(grid, lanes, queues, whole);
}

std::string_view arithmetic() {
    return HWY_DYNAMIC_DISPATCH(arithmetic_name)();
}

std::vector<std::int64_t> instruction_sets() {
    return hwy::SupportedAndGeneratedTargets();
}

std::string_view name_of(std::int64_t instruction_set) {
    return hwy::TargetName(instruction_set);
}

void use_instruction_set(std::int64_t instruction_set) {
    hwy::GetChosenTarget().Update(instruction_set != 0 ? instruction_set : hwy::SupportedTargets());
}

}  // namespace peterka::batch
#endif
