#include "regime/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "regime/growth.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/recurrence.hpp"
#include "regime/settling.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

namespace {

using trajectory::Cycle;

// Force and impacts over the cycles that count for a motion without a period.
struct Window {
    std::int64_t cycles = 0;
    std::int64_t impacts = 0;
    double peak_force = 0;
    double largest_displacement = 0;

    void add(const Passage& cycle) {
        ++cycles;
        impacts += cycle.impacts;
        peak_force = std::max(peak_force, cycle.peak_force);
        largest_displacement = std::max(largest_displacement, cycle.largest_displacement);
    }
};

Status status_of(Cycle<double>::Outcome outcome) {
    switch (outcome) {
        case Cycle<double>::Outcome::too_many_events:
            return Status::too_many_events;
        case Cycle<double>::Outcome::not_finite:
            return Status::not_finite;
        case Cycle<double>::Outcome::solver_failed:
            return Status::solver_failed;
        case Cycle<double>::Outcome::done:
            break;
    }
    return Status::proved;
}

class Search {
  public:
    Search(const scene::Oscillator<double>& scene, const scene::State<double>& start, const Budget& budget,
           const EngineSettings& engine)
        : scene_(scene),
          budget_(budget),
          map_(scene, engine),
          settling_(map_),
          recurrence_(budget.max_period, scene.cubic != 0),
          state_(map_.scaled(start)),
          measure_from_(std::min<std::int64_t>(Growth::settling_cycles, budget.max_cycles / 2)),
          conservative_(scene.damping_ratio == 0 && scene.kelvin_voigt().damping == 0) {}

    CellResult run() {
        for (std::int64_t cycle = 0;; ++cycle) {
            const auto state = map_.unscaled(state_);
            if (const auto free = settling_.stays_free(state)) return settled(*free, Regime::no_impact);
            if (const auto contact = settling_.stays_in_contact(state)) {
                return settled(*contact, Regime::sustained_contact);
            }
            const bool ends = cycle == budget_.max_cycles || (conservative_ && cycle == budget_.chaos_cycles);
            if (ends)
                return unproved(Regime::unresolved, conservative_ ? Status::conservative : Status::budget);
            const bool measured = cycle >= measure_from_;
            const Passage passage = map_.advance(state_, 1, measured);
            if (!passage.ok) return failed(passage.outcome);
            state_ = passage.end;
            growth_.advance(passage.jacobian);
            if (measured) window_.add(passage);

            if (conservative_) continue;  // nothing recurs for good
            recurrence_.record(passage);
            if (converged(passage)) return periodic(test_->orbit());
            if (cycle + 1 >= budget_.chaos_cycles && growth_.block_just_closed() && growth_.surely_positive()) {
                return unproved(Regime::chaotic, Status::proved);
            }
        }
    }

  private:
    // Looks for an orbit, or goes on testing whether the trajectory converges to the one found.
    bool converged(const Passage& last_cycle) {
        if (!test_) {
            const auto q = recurrence_.candidate();
            if (!q) return false;
            const auto orbit = find_stable_orbit(map_, recurrence_, *q);
            if (!orbit) return false;
            test_.emplace(*orbit, state_, map_.noise());
            tested_cycles_ = 0;
            pattern_ = 0;
            return false;
        }
        pattern_ = append(pattern_, last_cycle.pattern);
        if (++tested_cycles_ < test_->orbit().period) return false;
        const auto verdict = test_->advance(state_, pattern_);
        tested_cycles_ = 0;
        pattern_ = 0;
        if (verdict == ConvergenceTest::Verdict::refuted) test_.reset();
        return verdict == ConvergenceTest::Verdict::proved;
    }

    CellResult periodic(const PeriodicOrbit& orbit) {
        const Passage passage = map_.advance(orbit.point, orbit.period, true);
        if (!passage.touched || !passage.separated) {
            return settled(
                {map_.unscaled(orbit.point), orbit.jacobian, passage.peak_force, passage.largest_displacement},
                passage.touched ? Regime::sustained_contact : Regime::no_impact);
        }
        CellResult result = on_orbit(orbit.jacobian, orbit.period, map_.unscaled(lowest_point(orbit)));
        result.regime = Regime::periodic;
        result.impacts = passage.impacts;
        result.period = static_cast<std::int32_t>(orbit.period);
        result.peak_force = passage.peak_force;
        result.largest_displacement = passage.largest_displacement;
        result.impact_rate = static_cast<double>(passage.impacts) / static_cast<double>(orbit.period);
        return result;
    }

    // One of the q points names the orbit, whatever start and phase led to it.
    Point lowest_point(const PeriodicOrbit& orbit) {
        Point lowest = orbit.point;
        Point point = orbit.point;
        for (std::int64_t n = 1; n < orbit.period; ++n) {
            point = map_.advance(point, 1).end;
            if (point[0] < lowest[0]) lowest = point;
        }
        return lowest;
    }

    CellResult settled(const SettledMotion& motion, Regime regime) {
        CellResult result = on_orbit(motion.jacobian, 1, motion.point);
        result.regime = regime;
        result.period = 1;
        result.peak_force = motion.peak_force;
        result.largest_displacement = motion.largest_displacement;
        return result;
    }

    CellResult unproved(Regime regime, Status status) {
        CellResult result = counted();
        result.regime = regime;
        result.status = status;
        result.peak_force = window_.peak_force;
        result.largest_displacement = window_.largest_displacement;
        const auto cycles = static_cast<double>(std::max<std::int64_t>(window_.cycles, 1));
        result.impact_rate = static_cast<double>(window_.impacts) / cycles;
        result.lyapunov = growth_.exponent();
        return result;
    }

    CellResult failed(Cycle<double>::Outcome outcome) {
        CellResult result = counted();
        result.regime = Regime::failed;
        result.status = status_of(outcome);
        result.impact_rate = unknown;
        return result;
    }

    CellResult on_orbit(const Eigen::Matrix2d& jacobian, std::int64_t period,
                        const scene::State<double>& point) {
        CellResult result = counted();
        result.multiplier = spectral_radius(jacobian);
        result.lyapunov = std::log(result.multiplier) / static_cast<double>(period);
        result.orbit_displacement = point[0] + scene_.gap;
        result.orbit_velocity = point[1];
        return result;
    }

    CellResult counted() {
        CellResult result;
        result.engine = map_.engine();
        result.cycles = static_cast<std::int32_t>(
            std::min<std::int64_t>(map_.cycles_spent(), std::numeric_limits<std::int32_t>::max()));
        result.sensitivity = growth_.sensitivity();
        return result;
    }

    scene::Oscillator<double> scene_;
    Budget budget_;
    StroboscopicMap map_;
    Settling settling_;
    Recurrence recurrence_;
    Growth growth_;
    Window window_;
    Point state_;  // at the end of the last cycle
    std::optional<ConvergenceTest> test_;
    EventPattern pattern_ = 0;
    std::int64_t tested_cycles_ = 0;
    std::int64_t measure_from_;
    bool conservative_;
};

}  // namespace

CellResult find_steady_state(const scene::Oscillator<double>& scene, const scene::State<double>& start,
                             const Budget& budget, const EngineSettings& engine) {
    return Search(scene, start, budget, engine).run();
}

}  // namespace peterka::regime
