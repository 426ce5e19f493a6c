// The equations of an orbit, and the conditions that single out a branch of orbits, a curve or a point on it.
//
// 2 equations for each leg: its end is where the next event begins. Events that don't graze bring 2 unknowns, a
// grazing one brings 1; the place brings 2 more. So the orbits without a grazing form a surface over the plane,
// those with one a curve, and each condition takes away one dimension.
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
        bifurcation,  // a multiplier is `sign`, on a side of the grazing
        slow,         // an event has velocity 0
        inflection,   // delta'' is 0 where it grazes, too
    };
    Kind kind = Kind::line;
    PlanePoint through = {};  // line: a point of it,
    PlanePoint normal = {};   // and what is perpendicular to it
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

// Sizes in which unknowns are measured, so that a step of 1 is a large one in each of them.
[[nodiscard]] Eigen::VectorXd sizes_of_unknowns(const Rig& rig, const OrbitPoint& point,
                                                const PlanePoint& window);

// Largest value of the equations of the orbit and the bifurcation, relative to the hammer's velocities.
[[nodiscard]] double residual(const OrbitPoint& point, const Equations& equations);

// Newton's method, by the shortest step where there are fewer equations than unknowns. None where it leads
// nowhere, or further away than one size.
[[nodiscard]] std::optional<OrbitPoint> solve(const Rig& rig, OrbitPoint guess, const PlanePoint& window,
                                              const std::vector<Condition>& conditions);

// The direction in which a curve goes on, in sizes of the unknowns and of length 1.
[[nodiscard]] Eigen::VectorXd tangent(const Rig& rig, const OrbitPoint& point, const PlanePoint& window,
                                      const std::vector<Condition>& conditions);

inline constexpr double largest_residual = 1e-11;  // of a point that is kept

}  // namespace peterka::curves
