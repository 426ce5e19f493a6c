// What exists in a cell though none of its starts ended there: the motion without impact, which is known in
// closed form, and those of a cell beside it, continued to this one.
#pragma once

#include <cstdint>
#include <span>

#include "cell/result.hpp"
#include "job/job.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "scene/scene.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// One that has an orbit, as another cell, or this one, knows it.
struct KnownMotion {
    cell::Regime regime = cell::Regime::failed;
    std::int32_t impacts = 0;
    std::int32_t period = 0;
    double displacement = 0;  // of the orbit's first point, as of a cell
    double velocity = 0;
};

// Whether a cell that knows these knows this one: any may have been found with the cubic spring or without.
[[nodiscard]] bool is_known(const KnownMotion& motion, std::span<const KnownMotion> known,
                            const scene::Oscillator<double>& oscillator);

// The job of these searches: they begin where they end, and ask for nothing that is not kept of attractors.
[[nodiscard]] job::Job job_of_continuation(job::Job job);

// Whether there is a motion without impact, as far as linear springs tell.
[[nodiscard]] bool may_stay_free(const scene::Oscillator<double>& oscillator);
// It; any other regime where the cubic spring lets it reach the stop.
[[nodiscard]] Task<cell::CellResult> free_motion(regime::CycleBroker& broker, const job::Job& job,
                                                 scene::Cell cell);

// The orbit to which Newton's method leads from another cell's, solved like any start that begins on it; what
// is known already, or isn't stable, comes as failed. `known` and the job must outlive this.
[[nodiscard]] Task<cell::CellResult> continued_motion(regime::CycleBroker& broker, const job::Job& job,
                                                      scene::Cell cell, KnownMotion from,
                                                      std::span<const KnownMotion> known);

}  // namespace peterka::attractors
