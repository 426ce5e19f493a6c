// A curve traced from a seed, both ways, until it leaves the window, ends at a special point or closes.
#pragma once

#include <vector>

#include "certificate/branch_crossing.hpp"
#include "curves/follow.hpp"

namespace peterka::curves {

// Codimension-2 points (cusp: Kuznetsov 2004, ch. 9; with grazing: Kowalczyk et al. 2006, Int. J. Bifurcation
// Chaos 16, 601; generalized period doubling: Kuznetsov 2004, section 9.4). Stored as int8; the numbers are
// part of the file format. The multipliers are never both +-1 or a pair on the unit circle: det M < 1 with any
// dissipation.
enum class SpecialKind : std::int8_t {
    fold_grazing = 0,      // a multiplier is 1 at a grazing
    flip_grazing = 1,      // a multiplier is -1 at a grazing
    double_grazing = 2,    // two simultaneous grazings
    cusp = 3,              // two folds meet
    inflection = 4,        // the acceleration vanishes at a grazing, too: a touch from one side of the surface
                           // becomes one from the other
    generalized_flip = 5,  // a fold of 2q cycles merges with the period doubling of q, which from there on has
                           // the orbits of 2q cycles on its other side
};

// Whether labels of the coarse map change at a point of a curve and, if not, why. Stored as int8; the numbers
// are part of the file format.
enum class LabelEdge : std::int8_t {
    edge = 0,         // they do within a cell, from or to that of a motion that ends or changes there
    same_label = 1,   // adjacent cells have such a label, but on both sides
    other_start = 2,  // such a motion exists a cell's width away, too, but [start] leads elsewhere there
    narrow = 3,       // no such motion exists that far from the curve
    unknown = 4,      // no such motion could be followed
};

inline constexpr std::size_t label_edge_kinds = 5;

struct CurvePoint {
    PlanePoint place;
    double multiplier = 0;  // of the orbit without the grazing impact; largest modulus, with its sign
    double peak_force = 0;  // F/(k A0)
    double residual = 0;
    State<double> at_phase_0{0, 0};  // of the orbit's first cycle: (delta, delta')
    LabelEdge edge = LabelEdge::unknown;
    Orbit orbit;  // not sent between ranks
    // to distinguish curves
    double trace = 0;        // of the orbit's monodromy matrix
    double total_speed = 0;  // of all impacts
    std::int64_t impacts = 0;
};

struct Special {
    SpecialKind kind = SpecialKind::cusp;
    PlanePoint place;
};

// Where a curve crosses one of the requested gaps.
struct Crossing {
    PlanePoint place;
    double multiplier = 0;  // as in CurvePoint
    double peak_force = 0;
    Orbit orbit;
    certificate::CrossingProof proof = {};  // if requested; not sent between ranks
};

enum class CurveEnd : std::int8_t { border = 0, special = 1, closed = 2, lost = 3 };

struct Curve {
    CurveKind kind = CurveKind::fold;
    std::int64_t impacts = 0;  // of the stable orbit beside the curve
    std::int64_t period = 1;
    std::vector<CurvePoint> points;
    std::vector<Special> specials;
    std::vector<Crossing> crossings;
    LabelEdge edge = LabelEdge::unknown;  // of all points; edge only if a motion was followed to the curve
    CurveEnd begins = CurveEnd::lost;
    CurveEnd ends = CurveEnd::lost;
};

// The part of the plane in which curves are traced.
struct Window {
    PlanePoint low;
    PlanePoint high;
    std::vector<double> gaps = {};  // requested for crossings, as coordinates
    std::size_t gap_axis = 1;       // of the gaps: 0 along the columns
    [[nodiscard]] PlanePoint size() const { return {high.column - low.column, high.row - low.row}; }
    // The border is included, up to rounding.
    [[nodiscard]] bool holds(const PlanePoint& place, double beyond = 1e-9) const {
        const double across = beyond * size().column;
        const double up = beyond * size().row;
        return place.column >= low.column - across && place.column <= high.column + across &&
               place.row >= low.row - up && place.row <= high.row + up;
    }
};

[[nodiscard]] CurvePoint curve_point(const Rig& rig, const OrbitPoint& point, CurveKind kind);

// Without points if the seed bounds no stable motion.
[[nodiscard]] Curve trace_curve(const Rig& rig, const Seed& seed, const Window& window);

}  // namespace peterka::curves
