// The motion that a trace shows: the scene and engine that carry it, its start and its length.
//
// The decision procedure of maps settles scene and start: an orbit is followed from its own point, chaos from
// where a map starts to observe it, and the scene is the one that the procedure chose, with its cubic spring or
// without. A cart at rest has no regime; its springs are kept linear if the motion itself stays as small as
// omit_tolerance allows.
#pragma once

#include <cstdint>
#include <optional>

#include "regime/cell_result.hpp"
#include "regime/engine.hpp"
#include "scene/scene.hpp"
#include "trace/watcher.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::trace {

struct Course {
    scene::Oscillator<double> oscillator;
    regime::EngineSettings settings;
    scene::State<double> start;  // (delta, delta') at forcing phase 0, where the trace begins
    double length = 0;           // tau
    std::int64_t skipped = 0;    // forcing cycles skipped after the job's start, for a motion without a period
    std::int64_t period = 0;     // q if the trace is part of a proved orbit, else 0
    std::optional<regime::CellResult> cell = {};  // the map's result; none for a cart at rest
};

// Throws Failure if the motion can't be followed to the beginning of the trace.
[[nodiscard]] Course prepare(const scene::Scene& scene);

// Shows the watcher the motion from the beginning of the trace through all cycles that begin before its end,
// and returns a recorder's totals over it. Throws Failure if the motion ends earlier.
trajectory::Totals<double> follow(const Course& course, Watcher& watcher);

}  // namespace peterka::trace
