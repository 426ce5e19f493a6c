// A curve from a seed on, both ways, until it leaves the window, ends at a special point or closes.
#pragma once

#include <vector>

#include "curves/follow.hpp"

namespace peterka::curves {

// Codimension-two points. Stored as int8; the numbers are part of the file format. Multipliers are never both
// +-1 or a pair on the unit circle: det M < 1 wherever anything dissipates.
enum class SpecialKind : std::int8_t {
    fold_grazing = 0,    // a multiplier is 1 where an impact is just gained or lost
    flip_grazing = 1,    // the same with -1
    double_grazing = 2,  // two at once
    cusp = 3,            // two folds meet
    inflection = 4,      // where the hammer grazes its acceleration is 0, too: a touch from one side of the
                         // surface becomes one from the other
};

// Whether labels of the coarse map change at a point of a curve, and, where they don't, why. Stored as int8;
// the numbers are part of the file format.
enum class LabelEdge : std::int8_t {
    edge = 0,         // within a cell they do, from or to that of a motion that ends or changes there
    same_label = 1,   // cells beside it have such a label, but on both sides
    other_start = 2,  // such a motion lives a cell's breadth away, too, but [start] ends elsewhere there
    narrow = 3,       // no such motion lives that far from the curve
    unknown = 4,      // none of them could be followed
};

inline constexpr std::size_t label_edge_kinds = 5;

struct CurvePoint {
    PlanePoint place;
    double multiplier = 0;  // of the orbit without the grazing impact; largest in size, with its sign
    double peak_force = 0;  // F/(k A0)
    double residual = 0;
    State<double> at_phase_0{0, 0};  // of the orbit's first cycle: (delta, delta')
    LabelEdge edge = LabelEdge::unknown;
    Orbit orbit;  // not for the way between ranks
    // to tell curves apart
    double trace = 0;        // of the orbit's monodromy matrix
    double total_speed = 0;  // of all impacts
};

struct Special {
    SpecialKind kind = SpecialKind::cusp;
    PlanePoint place;
};

// Where a curve has one of the gaps that were asked for.
struct Crossing {
    PlanePoint place;
    double multiplier = 0;  // as those of a CurvePoint
    double peak_force = 0;
    Orbit orbit;
};

enum class CurveEnd : std::int8_t { border = 0, special = 1, closed = 2, lost = 3 };

struct Curve {
    CurveKind kind = CurveKind::fold;
    std::int64_t impacts = 0;  // of the orbit that is stable next to the curve
    std::int64_t period = 1;
    std::vector<CurvePoint> points;
    std::vector<Special> specials;
    std::vector<Crossing> crossings;
    LabelEdge edge = LabelEdge::unknown;  // of all points; an edge is one across which a motion was followed
    CurveEnd begins = CurveEnd::lost;
    CurveEnd ends = CurveEnd::lost;
};

// The part of the plane in which curves are wanted.
struct Window {
    PlanePoint low;
    PlanePoint high;
    std::vector<double> gaps = {};  // at which the places of curves are told, as coordinates
    std::size_t gap_axis = 1;       // of them: 0 along the columns
    [[nodiscard]] PlanePoint size() const { return {high.column - low.column, high.row - low.row}; }
    // Its border belongs to it, as far as rounding lets tell.
    [[nodiscard]] bool holds(const PlanePoint& place, double beyond = 1e-9) const {
        const double across = beyond * size().column;
        const double up = beyond * size().row;
        return place.column >= low.column - across && place.column <= high.column + across &&
               place.row >= low.row - up && place.row <= high.row + up;
    }
};

[[nodiscard]] CurvePoint curve_point(const Rig& rig, const OrbitPoint& point, CurveKind kind);

// Without points where the seed bounds nothing stable.
[[nodiscard]] Curve trace_curve(const Rig& rig, const Seed& seed, const Window& window);

}  // namespace peterka::curves
