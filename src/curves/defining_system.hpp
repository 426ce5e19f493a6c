// The defining system of an orbit, and the conditions that select a branch of orbits, a curve or a point on it.
//
// Multiple shooting from event to event: each leg gives 2 equations, that it ends where the next event begins.
// A grazing event has 1 unknown, any other event 2; the place has 2 more. So the orbits without a grazing form
// a surface over the plane, those with one a curve, and each condition removes one dimension.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "curves/monodromy.hpp"
#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

struct Condition {
    enum class Kind : std::uint8_t {
        line,         // the place lies on a line
        bifurcation,  // a multiplier equals `sign`, on one side of a grazing
        slow,         // an event has velocity 0
        inflection,   // delta'' = 0 at a grazing
    };
    Kind kind = Kind::line;
    PlanePoint through = {};  // line: a point on it,
    PlanePoint normal = {};   // and its normal
    int sign = 1;
    Side side = Side::without_impact;
    std::size_t event = 0;

    static Condition on_line(const PlanePoint& through, const PlanePoint& normal);
    static Condition at_multiplier(int sign, Side side = Side::without_impact);
    static Condition at_rest(std::size_t event);
    static Condition without_acceleration(std::size_t event);
};

// Values of all equations and conditions, and their derivatives by the unknowns.
struct Equations {
    Eigen::VectorXd values;
    Eigen::MatrixXd jacobian;
};
[[nodiscard]] Equations equations(const Rig& rig, const OrbitPoint& point,
                                  const std::vector<Condition>& conditions);

// Scales of the unknowns: a step of 1 in a scaled unknown is a large one.
[[nodiscard]] Eigen::VectorXd sizes_of_unknowns(const Rig& rig, const OrbitPoint& point,
                                                const PlanePoint& window);

// Largest residual of the equations and conditions, relative to 1 + the hammer's largest speed.
[[nodiscard]] double residual(const OrbitPoint& point, const Equations& equations);

// Newton's method, with the minimum-norm step if there are fewer equations than unknowns. None if it does not
// converge to `largest_residual`, if a scaled step is not shorter than 0.5, if a number is not finite, or if a
// contact would run backwards.
[[nodiscard]] std::optional<OrbitPoint> solve(const Rig& rig, OrbitPoint guess, const PlanePoint& window,
                                              const std::vector<Condition>& conditions);

// The unit tangent of a curve, in scaled unknowns.
[[nodiscard]] Eigen::VectorXd tangent(const Rig& rig, const OrbitPoint& point, const PlanePoint& window,
                                      const std::vector<Condition>& conditions);

inline constexpr double largest_residual = 1e-11;  // of an accepted point

}  // namespace peterka::curves
