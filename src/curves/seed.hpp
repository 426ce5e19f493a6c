// A point of a curve, and the kind of the curve.
#pragma once

#include <cstdint>
#include <vector>

#include "curves/defining_system.hpp"

namespace peterka::curves {

// Stored as int8; the numbers are part of the file format.
enum class CurveKind : std::int8_t { fold = 0, period_doubling = 1, grazing = 2 };

struct Seed {
    CurveKind kind = CurveKind::fold;
    OrbitPoint point;
};

// The conditions on a point of a curve, besides the equations of its orbit.
[[nodiscard]] inline std::vector<Condition> conditions_of(CurveKind kind) {
    if (kind == CurveKind::fold) return {Condition::at_multiplier(1)};
    if (kind == CurveKind::period_doubling) return {Condition::at_multiplier(-1)};
    return {};
}

}  // namespace peterka::curves
