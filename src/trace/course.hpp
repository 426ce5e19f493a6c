// The motion that a trace shows: which scene and engine carry it, where it begins and how long it lasts.
//
// The decision procedure of maps settles both: an orbit is followed from its own point, chaos from where a map
// starts to observe it, and the scene is the one that procedure chose, with its cubic spring or without. A cart
// at rest has no regime; its springs are kept linear where the motion itself stays as small as omit_tolerance
// allows.
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
    std::int64_t skipped = 0;    // forcing cycles from the job's start to there, of a motion without a period
    std::int64_t period = 0;     // q where the trace is a stretch of a proved orbit, 0 elsewhere
    std::optional<regime::CellResult> cell = {};  // what a map says of it; none with a cart at rest
};

// Throws Failure where the motion can't be followed to where the trace begins.
[[nodiscard]] Course prepare(const scene::Scene& scene);

// Lets the watcher see the motion from the beginning of the trace through all cycles that begin before its end,
// and gives what a recorder gathers on the way. Throws Failure where the motion ends before.
trajectory::Totals<double> follow(const Course& course, Watcher& watcher);

}  // namespace peterka::trace
