// The distance of a coarse map's cell from where its own motion ends or changes, along each axis of the plane.
//
// The cell's orbit is followed along its row or column, both ways, to the first fold, period doubling or
// grazing, which is solved for like a point of a curve. Coexisting motions are ignored.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "curves/coarse_map.hpp"

namespace peterka::curves {

// Stored as int8; the numbers are part of the file format. The first three are those of CurveKind.
enum class EdgeKind : std::int8_t {
    fold = 0,
    period_doubling = 1,
    grazing = 2,
    none = 3,        // within the window
    unknown = 4,     // the orbit could not be followed far enough
    no_orbit = -128  // not an orbit that curves cover: chaos, say, or too long a period
};

struct EdgeDistance {
    // Signed change of the axis's value to the nearest edge; NaN if there is none.
    double change = std::numeric_limits<double>::quiet_NaN();
    EdgeKind kind = EdgeKind::no_orbit;
};

// The cells of one row, column by column, or of one column.
struct LineOfCells {
    bool is_row = true;
    std::int64_t number = 0;
};

// The number in the map of a line's i-th cell.
[[nodiscard]] std::int64_t cell_of(const CoarseMap& map, const LineOfCells& line, std::int64_t i);

// In the order of the line.
[[nodiscard]] std::vector<EdgeDistance> edge_distances(const CoarseMap& map, const Rig& rig,
                                                       std::int64_t most_period, const LineOfCells& line);

}  // namespace peterka::curves
