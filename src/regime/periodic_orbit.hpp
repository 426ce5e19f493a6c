// Periodic orbits of the stroboscopic map: found by Newton's method, reduced to their smallest period, and a
// test that a trajectory really converges to one.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "regime/adapted_norm.hpp"
#include "regime/recurrence.hpp"
#include "regime/stroboscopic_map.hpp"
#include "support/task.hpp"

namespace peterka::regime {

struct PeriodicOrbit {
    Points points;             // at forcing phase 0, one cycle after the other: q of them
    Eigen::Matrix2d jacobian;  // of the q-cycle map at the first point
    double multiplier = 0;     // spectral radius of the Jacobian
    EventPattern pattern = 0;  // of the q cycles from the first point
    double error = 0;          // of the points, relative: Newton's last correction, made
    bool touched = false;      // the stop presses at some time

    [[nodiscard]] const Point& point() const { return points.front(); }
    [[nodiscard]] std::int64_t period() const { return static_cast<std::int64_t>(points.size()); }
};

// The orbit of as many points, stable or not, that Newton's method reaches from those guessed. None where the
// cycles from these stretch a perturbation by more than most_stretch.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Points guess,
                                              double most_stretch = std::numeric_limits<double>::infinity());
// The same from a single point; the others are those to which it leads.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Point guess, std::int64_t q);

// Surely inside the unit circle, as far as rounding lets tell.
bool is_stable(const PeriodicOrbit& orbit);
// Whether the orbit returns to its point, or nearly, after a divisor of its period.
bool has_smaller_period(const PeriodicOrbit& orbit);

// One of the q points names the orbit, whatever start and phase led to it: the lowest, and of those that are
// alike the slowest. It comes first from now on; how many points came before it.
std::size_t put_lowest_point_first(PeriodicOrbit& orbit);

// A stable orbit of period q, or of a divisor of q, that Newton's method reaches from the trajectory's present
// state and on which the contacts are those of the trajectory's last cycles.
Task<std::optional<PeriodicOrbit>> find_stable_orbit(StroboscopicMap& map, const Recurrence& trajectory,
                                                     std::int64_t q);
// Whether Newton's method reaches a stable orbit of at most the longest period from where the trajectory nearly
// closed.
Task<bool> is_stable_orbit_near(StroboscopicMap& map, const Recurrence& trajectory, std::int64_t longest);

// Decides whether a trajectory converges to an orbit. Over one period, the distance e0 to the orbit becomes e1;
// where e1 - J e0 is small against what J contracts, in a norm in which it does contract, the distance shrinks
// for good.
class ConvergenceTest {
  public:
    enum class Standing { open, proved, refuted };

    // noise: relative error of a cycle beyond rounding.
    ConvergenceTest(const PeriodicOrbit& orbit, const Point& state, double noise);

    [[nodiscard]] const PeriodicOrbit& orbit() const { return orbit_; }
    // The state one orbit period later, and the pattern of the cycles in between.
    Standing advance(const Point& state, EventPattern pattern);
    // One cycle more. It stays open up to the end of a period.
    Standing follow(const CycleResult& cycle);

  private:
    PeriodicOrbit orbit_;
    AdaptedNorm norm_;
    double at_rest_;  // below this distance the remainder is rounding, and both points lie on one smooth branch
    Point error_;
    int in_a_row_ = 0;
    int failures_ = 0;
    std::int64_t followed_ = 0;  // cycles of the present period
    EventPattern pattern_ = 0;   // of these
};

// After the last two periods of a trajectory.
[[nodiscard]] ConvergenceTest::Standing standing_of(const Recurrence& trajectory, const PeriodicOrbit& orbit,
                                                    double noise);

}  // namespace peterka::regime
