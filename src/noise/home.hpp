// A settled motion, and how far a state is from it in units of what weak disturbances do to it: the Mahalanobis
// distance from the nearest of its points at forcing phase 0, by the stationary covariance of the linearized
// motion (the discrete Lyapunov equation P = M P M^T + Q; e.g. Gardiner 2009, Stochastic Methods, 4.5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "noise/disturbed_map.hpp"
#include "scene/oscillator.hpp"
#include "support/random_numbers.hpp"

namespace peterka::noise {

class Home {
  public:
    // The motion of period q next to a state at forcing phase 0, by Newton's method. Nothing where the engine
    // doesn't return to about that state after q cycles, or where the linearized motion isn't stable or takes
    // more cycles than that to relax: what home takes back is found in 250 times as many, or more.
    [[nodiscard]] static std::optional<Home> of(DisturbedMap& map, const scene::State<double>& at_phase_0,
                                                int period,
                                                double most_to_relax = std::numeric_limits<double>::infinity());

    // Of a state at phase 0.
    [[nodiscard]] double distance(const scene::State<double>& state) const;
    [[nodiscard]] const scene::State<double>& first_point() const { return points_.front().state; }
    // Up to this distance it is at home: two standard deviations, or less where states as far away would not
    // return without disturbances, as far as a sample shows.
    [[nodiscard]] double radius() const { return radius_; }
    // Cycles in which the slowest of small deviations shrinks by e.
    [[nodiscard]] double to_relax() const { return to_relax_; }
    // Of what disturbances add to its n-th point, to first order.
    [[nodiscard]] const scene::Jacobian<double>& covariance(int n) const {
        return points_[static_cast<std::size_t>(n)].covariance;
    }

    // Whether the motion from a state at phase 0 returns to where it is at home if it is not disturbed; nothing
    // where the engine can't follow it. elsewhere: points of other settled motions, to which those found are
    // added. times: how many times 500 cycles, or twenty times to_relax(), it is waited for.
    [[nodiscard]] std::optional<bool> takes_back(DisturbedMap& map, scene::State<double> state,
                                                 std::vector<scene::State<double>>& elsewhere,
                                                 double times = 1) const;
    // How many of these states would return: all or none, by one of them at random, which is right in the mean.
    [[nodiscard]] std::int64_t returning(DisturbedMap& map, std::span<const scene::State<double>> states,
                                         RandomNumbers& random,
                                         std::vector<scene::State<double>>& elsewhere) const;

  private:
    struct Point {
        scene::State<double> state;
        scene::Jacobian<double> covariance;
        scene::Jacobian<double> precision;  // its inverse
    };
    [[nodiscard]] double find_radius(DisturbedMap& map);
    [[nodiscard]] bool takes_back_from(DisturbedMap& map, double distance) const;
    [[nodiscard]] bool is_at_a_point(const scene::State<double>& state) const;

    std::vector<Point> points_;
    double to_relax_ = 0;
    double spread_ = 0;  // the largest deviation from a point
    double radius_ = 0;
};

}  // namespace peterka::noise
