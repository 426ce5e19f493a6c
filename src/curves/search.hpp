// All curves of a window: from the edges of a coarse map to seeds, and from seeds to curves, each one once.
//
// What is dealt to ranks are tasks whose results depend on their numbers alone, and what follows from all
// results is worked out by each rank by itself: so nothing depends on the number of ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "curves/coarse_map.hpp"
#include "curves/edge_distance.hpp"
#include "curves/trace_curve.hpp"
#include "curves/unstable_branch.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

// Has tasks 0 to count - 1 done, and gives their results in this order; may throw Stopped.
using Task = std::function<Numbers(std::int64_t task)>;
using Deal = std::function<std::vector<Numbers>(std::int64_t count, const Task& task)>;

// Edges of the coarse map; one where neither is known is unexplained.
struct EdgeCount {
    std::int64_t edges = 0;     // between periodic cells up to the period, or of one and no impact
    std::int64_t on_curve = 0;  // a curve lies within one cell
    std::int64_t basin = 0;     // the orbit of one side lives on the other, too: the start decides
    [[nodiscard]] std::int64_t unexplained() const { return edges - on_curve - basin; }
};

struct CurveSearchResult {
    std::vector<Site> sites;  // the coarse map, row by row
    // and of its cells, where the job asks for them
    std::vector<EdgeDistance> along_columns;
    std::vector<EdgeDistance> along_rows;
    std::vector<Curve> curves;             // in the order of the file
    std::vector<double> seconds;           // that each took
    std::vector<UnstableBranch> branches;  // by gap, period, impacts and frequency
    EdgeCount edges;
    std::int64_t periodic_cells = 0;  // of the coarse map, up to the period
    std::int64_t followed = 0;        // edges across which an orbit was followed
};

[[nodiscard]] CurveSearchResult find_curves(const scene::Scene& scene, const Deal& deal);

}  // namespace peterka::curves
