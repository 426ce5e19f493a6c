// Motions that exist in a cell although none of its starts ended there: the impact-free motion, known in closed
// form, and the motions of a neighbouring cell, continued to this one.
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

// A motion that has an orbit, as known from this cell or another.
struct KnownMotion {
    cell::Regime regime = cell::Regime::failed;
    std::int32_t impacts = 0;
    std::int32_t period = 0;
    double displacement = 0;  // of the orbit's first point, as in a cell's result
    double velocity = 0;
};

// Whether `known` contains the motion; any of them may have been found with or without the cubic spring.
[[nodiscard]] bool is_known(const KnownMotion& motion, std::span<const KnownMotion> known,
                            const scene::Oscillator<double>& oscillator);

// The job of these searches: they start on the orbit, and request nothing that is not kept for attractors.
[[nodiscard]] job::Job job_of_continuation(job::Job job);

// Whether an impact-free motion exists, judged by the linear springs.
[[nodiscard]] bool may_stay_free(const scene::Oscillator<double>& oscillator);
// The impact-free motion; any other regime where the cubic spring lets it reach the stop.
[[nodiscard]] Task<cell::CellResult> free_motion(regime::CycleBroker& broker, const job::Job& job,
                                                 scene::Cell cell);

// The orbit that Newton's method finds from another cell's, solved like any start that begins on it; `failed`
// if it is already known or not stable. `known` and the job must outlive this.
[[nodiscard]] Task<cell::CellResult> continued_motion(regime::CycleBroker& broker, const job::Job& job,
                                                      scene::Cell cell, KnownMotion from,
                                                      std::span<const KnownMotion> known);

}  // namespace peterka::attractors
