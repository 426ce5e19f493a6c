#include "job/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peterka::job {
namespace {

// Two roundings, never a fused multiply-add, whatever the target: the grid must not depend on the machine.
double evenly(double from, double to, std::int64_t i, std::int64_t points) {
    const double step = (to - from) / static_cast<double>(points - 1);
    const volatile double offset = static_cast<double>(i) * step;
    return from + offset;
}

}  // namespace

double axis_value(const Axis& axis, std::int64_t i) {
    if (i == 0) return axis.from;
    if (i == axis.points - 1) return axis.to;
    if (axis.scale == Spacing::linear) return evenly(axis.from, axis.to, i, axis.points);
    return std::exp(evenly(std::log(axis.from), std::log(axis.to), i, axis.points));
}

std::vector<double> axis_values(const Axis& axis) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(axis.points));
    for (std::int64_t i = 0; i < axis.points; ++i) values.push_back(axis_value(axis, i));
    return values;
}

bool resolves_its_points(const Axis& axis) {
    if (axis.points == 1) return true;
    // A value carries a rounding error of an ulp or two; 16 ulps between neighbours keep the order and the
    // spacing.
    constexpr double resolution = 16 * std::numeric_limits<double>::epsilon();
    const auto intervals = static_cast<double>(axis.points - 1);
    if (axis.scale == Spacing::linear) {
        const double magnitude = std::max(std::abs(axis.from), std::abs(axis.to));
        return (axis.to - axis.from) / intervals > resolution * magnitude;
    }
    // exp turns an absolute error of the logarithm into a relative one.
    const double magnitude = std::max({1.0, std::abs(std::log(axis.from)), std::abs(std::log(axis.to))});
    return (std::log(axis.to) - std::log(axis.from)) / intervals > resolution * magnitude;
}

}  // namespace peterka::job
