// All curves of a window: from the edges of a coarse map to seeds, and from seeds to curves, each traced once.
//
// Ranks are dealt tasks whose results depend on the task numbers alone, and each rank draws all further
// conclusions by itself, so that nothing depends on the number of ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "curves/coarse_map.hpp"
#include "curves/edge_distance.hpp"
#include "curves/trace_curve.hpp"
#include "curves/unstable_branch.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

// Runs tasks 0 to count - 1 and returns their results in this order; may throw Stopped. Tells, on one rank, how
// many tasks more are done.
using Task = std::function<Numbers(std::int64_t task)>;
using Done = std::function<void(std::int64_t count)>;
using Deal = std::function<std::vector<Numbers>(std::int64_t count, const Task& task, const Done& done)>;

// A stage of the search: `count` of a noun to be done. Told on every rank when it begins.
struct Stage {
    std::string_view what;  // "compute"
    std::string_view noun;  // "cells"
    std::int64_t count;
};
struct Watcher {
    std::function<void(const Stage&)> begins = [](const Stage&) {};
    Done advances = [](std::int64_t) {};  // on one rank at least, with what is done since the last call
};

// Edges of the coarse map; one that is neither on_curve nor basin is unexplained.
struct EdgeCount {
    std::int64_t edges = 0;     // between periodic cells up to the period, or one and no impact
    std::int64_t on_curve = 0;  // a curve on which the motion of one side may end lies within one cell
    std::int64_t basin = 0;     // the orbit of one side exists on the other, too: the start decides
    [[nodiscard]] std::int64_t unexplained() const { return edges - on_curve - basin; }
};

struct CurveSearchResult {
    std::vector<Site> sites;  // the coarse map, row by row
    // distances of its cells, if requested
    std::vector<EdgeDistance> along_columns;
    std::vector<EdgeDistance> along_rows;
    std::vector<Curve> curves;             // in the order of the file
    std::vector<double> seconds;           // taken by each
    std::vector<UnstableBranch> branches;  // sorted by gap, period, impacts and frequency
    EdgeCount edges;
    std::int64_t periodic_cells = 0;  // of the coarse map, up to the period
    double proof_seconds = 0;         // taken by the proofs of all crossings
};

[[nodiscard]] CurveSearchResult find_curves(const scene::Scene& scene, const Deal& deal,
                                            const Watcher& watcher = {});

}  // namespace peterka::curves
