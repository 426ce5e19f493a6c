// Periodic orbits of the stroboscopic map: found by Newton's method, reduced to their smallest period, and a
// test that a trajectory really converges to one.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "regime/adapted_norm.hpp"
#include "regime/recurrence.hpp"
#include "regime/stroboscopic_map.hpp"
#include "support/reused_memory.hpp"
#include "support/task.hpp"

namespace peterka::regime {

struct PeriodicOrbit {
    Points points;             // at forcing phase 0, one cycle after the other: q of them
    Eigen::Matrix2d jacobian;  // of the q-cycle map at the first point
    double multiplier = 0;     // spectral radius of the Jacobian
    EventPattern pattern = 0;  // of the q cycles from the first point
    double error = 0;          // relative, of the points: Newton's last correction, applied
    bool touched = false;      // the stop presses at some time

    [[nodiscard]] const Point& point() const { return points.front(); }
    [[nodiscard]] std::int64_t period() const { return static_cast<std::int64_t>(points.size()); }
};

// The orbit, stable or not, that Newton's method reaches from the guessed points. None if the cycles from these
// stretch a perturbation by more than most_stretch.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Points guess,
                                              double most_stretch = std::numeric_limits<double>::infinity());
// The same from a single point; the others are its images.
Task<std::optional<PeriodicOrbit>> find_orbit(StroboscopicMap& map, Point guess, std::int64_t q);

// Whether the multipliers lie inside the unit circle, as far as rounding allows to tell.
bool is_stable(const PeriodicOrbit& orbit);
// Whether the orbit returns to its point, or nearly, after a divisor of its period.
bool has_smaller_period(const PeriodicOrbit& orbit);

// Puts first the point that names the orbit, whatever start and phase led to it: the lowest, and among equally
// low ones that of the smallest velocity. Returns how many points preceded it.
std::size_t put_lowest_point_first(PeriodicOrbit& orbit);

// A stable orbit of period q, or of a divisor of q, that Newton's method reaches from the trajectory's present
// state and on which the contacts are those of the trajectory's last cycles.
Task<std::optional<PeriodicOrbit>> find_stable_orbit(StroboscopicMap& map, const Recurrence& trajectory,
                                                     std::int64_t q);
// Whether Newton's method reaches a stable orbit of period at most `longest` from where the trajectory nearly
// closed.
Task<bool> is_stable_orbit_near(StroboscopicMap& map, const Recurrence& trajectory, std::int64_t longest);

// Decides whether a trajectory converges to an orbit. Over one period, the deviation e0 from the orbit becomes
// e1; where e1 - J e0 is small compared with the contraction by J, in a norm in which J contracts, the distance
// keeps shrinking.
//
// With complex multipliers the deviation turns while it shrinks, and slowly if they are close to the unit
// circle: it may yet reach a contact that the trajectory has missed so far. To first order, the deviations from
// which the next period has the orbit's contacts are a convex set, with the orbit in it. All later deviations
// lie in the hull of the orbit and of those already followed, e0, ..., e(n-1), once en does.
class ConvergenceTest {
  public:
    enum class Standing { open, proved, refuted };

    // noise: relative error of a cycle beyond rounding.
    ConvergenceTest(const PeriodicOrbit& orbit, const Point& state, double noise);

    [[nodiscard]] const PeriodicOrbit& orbit() const { return orbit_; }
    // The state one orbit period later, and the pattern of the cycles in between.
    Standing advance(const Point& state, EventPattern pattern);
    // Counts failures from here on.
    void forgive() { failures_ = 0; }
    // One more cycle. The result stays open up to the end of a period.
    Standing follow(const CycleResult& cycle);

  private:
    PeriodicOrbit orbit_;
    AdaptedNorm norm_;
    double at_rest_;  // below this distance the remainder is rounding, and both points lie on one smooth branch
    Point error_;
    int in_a_row_ = 0;
    std::vector<Point, ReusingAllocator<Point>> followed_from_;  // deviations, of the periods in a row
    int failures_ = 0;
    std::int64_t followed_ = 0;  // cycles of the present period
    EventPattern pattern_ = 0;   // of these
};

// The test after the trajectory's last periods, begun anew where it was refuted, and what the last one showed.
struct TestOfPast {
    ConvergenceTest test;
    ConvergenceTest::Standing standing = ConvergenceTest::Standing::open;
};
[[nodiscard]] TestOfPast test_of_past(const Recurrence& trajectory, const PeriodicOrbit& orbit, double noise);

}  // namespace peterka::regime
