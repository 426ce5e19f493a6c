// A trace: one cell in time, seen as a whole, at its hardest impact, and in frequency.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.hpp"
#include "trace/course.hpp"
#include "trace/impacts.hpp"
#include "trace/quantities.hpp"
#include "trace/spectrum.hpp"

namespace peterka::trace {

// A close view of the hardest impact.
struct HardImpact {
    std::size_t index = 0;  // among all impacts
    std::vector<Instant> instants;
    Instant peak;  // meaningless on a rigid stop
    std::optional<Spectrum>
        spectrum;  // if the impact ends within the trace; of the flight, up to the trace's end
};

struct Trace {
    Course course;
    trajectory::Totals<double> totals;  // of all cycles begun
    std::vector<Instant> instants;
    std::vector<Impact> impacts;
    std::optional<HardImpact> hardest;
    Spectrum spectrum;
};

// Throws Failure if the motion can't be followed.
[[nodiscard]] Trace make_trace(const scene::Scene& scene);

// Force to which the stop jumps when touched at this speed; NaN if it is rigid.
[[nodiscard]] double force_at_touch(const scene::Oscillator<double>& oscillator, double speed);

}  // namespace peterka::trace
