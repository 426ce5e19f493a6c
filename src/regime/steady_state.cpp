#include "regime/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "regime/growth.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/recurrence.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/settling.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

namespace {

using trajectory::Cycle;
using trajectory::Totals;

Status status_of(Cycle<double>::Outcome outcome) {
    switch (outcome) {
        case Cycle<double>::Outcome::too_many_events:
            return Status::too_many_events;
        case Cycle<double>::Outcome::not_finite:
            return Status::not_finite;
        case Cycle<double>::Outcome::solver_failed:
        case Cycle<double>::Outcome::inside_stop:
            return Status::solver_failed;
        case Cycle<double>::Outcome::done:
            break;
    }
    return Status::proved;
}

// Of the cycles of an orbit.
struct Touches {
    bool some = false;
    bool separated = false;
    Cycle<double>::Outcome outcome = Cycle<double>::Outcome::done;  // of the first cycle that failed
};

bool is_conservative(const scene::Oscillator<double>& scene) {
    return scene.damping_ratio == 0 && scene::is_lossless(scene.contact);
}

class Search {
  public:
    Search(const scene::Oscillator<double>& scene, const scene::State<double>& start, const Budget& budget,
           const EngineSettings& engine, Measures measures, const AttractorTable* known, CycleDesk& desk)
        : scene_(scene),
          map_(scene, engine, desk),
          known_(known != nullptr ? known->of(scene, engine) : nullptr),
          settling_(map_),
          recurrence_(budget.max_period, scene.cubic != 0),
          state_(map_.scaled(start)),
          window_(measures.detail, touch_log(measures)),
          measure_from_(std::min<std::int64_t>(Growth::settling_cycles, budget.max_cycles / 2)),
          chaos_from_(settling_.may_settle() ? budget.chaos_cycles : budget.fewest_chaos_cycles()),
          last_cycle_(is_conservative(scene) ? std::min(budget.chaos_cycles, budget.max_cycles)
                                             : budget.max_cycles),
          measures_(measures),
          looks_at_each_(measures.force_per_cycle || measures.motion != nullptr),
          conservative_(is_conservative(scene)) {
        forget_motion();
    }

    Task<CellResult> run() {
        for (std::int64_t cycle = 0;; ++cycle) {
            if (const CellResult* attractor = known_ != nullptr ? known_->reached_from(state_) : nullptr) {
                co_return on_known(*attractor);
            }
            const auto state = map_.unscaled(state_);
            if (const auto free = settling_.stays_free(state)) {
                co_return co_await settled(*free, Regime::no_impact);
            }
            if (const auto contact = settling_.stays_in_contact(state)) {
                co_return co_await settled(*contact, Regime::sustained_contact);
            }
            const bool counts = cycle >= measure_from_;
            if (ahead_.empty()) {
                if (cycle == last_cycle_)
                    co_return unproved(Regime::unresolved,
                                       conservative_ ? Status::conservative : Status::budget);
                ahead_ = co_await map_.cycles(state_, counts ? &window_ : nullptr, order_from(cycle));
            }
            const Passage passage = map_.passage(ahead_.front());
            ahead_ = ahead_.subspan(1);
            if (!passage.ok) co_return failed(passage.outcome);
            state_ = passage.end;
            if (passage.touched) last_touched_ = cycle + 1;
            growth_.advance(passage.jacobian);
            if (counts) {
                ++window_cycles_;
                keep_peak(window_);
                keep_point(state_);
            }

            if (conservative_) continue;  // nothing recurs for good
            recurrence_.record(passage);
            if (test_ && converges(passage)) co_return co_await periodic(test_->orbit());
            if (!is_stop(cycle + 1)) continue;
            if (const std::int64_t q = test_ ? 0 : recurrence_.candidate(); q > 0) {
                const auto orbit = co_await find_stable_orbit(map_, recurrence_, q);
                if (orbit && converged(*orbit)) co_return co_await periodic(*orbit);
            }
            // after two resets it repeats, be it with a period beyond max_period, however wild it looks
            if (cycle + 1 >= chaos_from_ && growth_.resets() <= 1 && growth_.surely_positive()) {
                co_return unproved(Regime::chaotic, Status::proved);
            }
        }
    }

  private:
    // A motion that didn't settle at once is carried on, and looked at, by stages as long as a block of growth.
    // Orders end there, so that what is ordered meanwhile finds none of their cycles left.
    static_assert(Recurrence::early_cycles % Growth::block_cycles == 0);
    static bool is_stop(std::int64_t cycle) {
        return cycle <= Recurrence::early_cycles || cycle % Growth::block_cycles == 0;
    }
    // How many cycles can be ordered at once: no cycle goes beyond the one from which on they count.
    [[nodiscard]] std::size_t order_from(std::int64_t cycle) const {
        if (looks_at_each_ || cycle < Recurrence::early_cycles || !is_stop(cycle)) return 1;
        const std::int64_t turn = cycle < measure_from_ ? std::min(measure_from_, last_cycle_) : last_cycle_;
        return turn - cycle < Growth::block_cycles ? 1 : Growth::block_cycles;
    }

    // Tests with the cycles already there first. True: that is proof enough.
    bool converged(const PeriodicOrbit& orbit) {
        const std::int64_t q = orbit.period;
        tested_cycles_ = 0;
        pattern_ = 0;
        ConvergenceTest past(orbit, recurrence_.state(2 * q), map_.noise());
        using enum ConvergenceTest::Verdict;
        if (past.advance(recurrence_.state(q), recurrence_.pattern(q, q)) == open &&
            past.advance(recurrence_.state(), recurrence_.pattern(q)) == proved) {
            return true;
        }
        test_.emplace(orbit, state_, map_.noise());
        return false;
    }

    // Whether the trajectory is proved to converge to the orbit found.
    bool converges(const Passage& last_cycle) {
        pattern_ = append(pattern_, last_cycle.pattern);
        if (++tested_cycles_ < test_->orbit().period) return false;
        const auto verdict = test_->advance(state_, pattern_);
        tested_cycles_ = 0;
        pattern_ = 0;
        if (verdict == ConvergenceTest::Verdict::refuted) test_.reset();
        return verdict == ConvergenceTest::Verdict::proved;
    }

    Task<CellResult> periodic(PeriodicOrbit orbit) {
        Recorder<double> recorder(measures_.detail, touch_log(measures_));
        if (measures_.motion != nullptr) keep_orbit(orbit);
        const Touches touches = co_await record_period(orbit, recorder);
        if (touches.outcome != Cycle<double>::Outcome::done) co_return failed(touches.outcome);
        const Totals<double>& totals = recorder.totals();
        if (!touches.some || !touches.separated) {
            const SettledMotion motion{map_.unscaled(orbit.point), orbit.jacobian, totals.peak_force(),
                                       totals.displacement_bound};
            co_return co_await settled(motion, touches.some ? Regime::sustained_contact : Regime::no_impact);
        }
        CellResult result = on_orbit(orbit.jacobian, orbit.period, map_.unscaled(lowest_point(orbit)));
        result.regime = Regime::periodic;
        result.impacts = static_cast<std::int32_t>(totals.impacts);
        result.period = static_cast<std::int32_t>(orbit.period);
        measured(result, totals, orbit.period);
        co_return result;
    }

    // One period of an orbit. What is open at its start counts in full at its end, as in every later period.
    Task<Touches> record_period(const PeriodicOrbit& orbit, Recorder<double>& recorder) {
        Touches touches;
        for (int round = 0; round == 0 || (round == 1 && recorder.is_open()); ++round) {
            recorder.reset_totals();
            cycle_peaks_.clear();
            for (const Point& point : orbit.points) {
                const Passage cycle = co_await map_.cycle(point, &recorder);
                if (!cycle.ok) co_return {.outcome = cycle.outcome};
                touches.some |= cycle.touched;
                touches.separated |= cycle.separated;
                keep_peak(recorder);
            }
        }
        co_return touches;
    }

    static Latest<trajectory::Touch<double>>* touch_log(const Measures& measures) {
        return measures.motion == nullptr ? nullptr : &measures.motion->touches;
    }

    void keep_point(const Point& point) {
        if (measures_.motion != nullptr) measures_.motion->stroboscopic.add(map_.unscaled(point));
    }

    // From the orbit's lowest point on, so that it looks the same from wherever it was reached.
    void keep_orbit(PeriodicOrbit& orbit) {
        measures_.motion->stroboscopic.clear();
        measures_.motion->end = map_.unscaled(orbit.point);
        const auto lowest = std::ranges::min_element(orbit.points, {}, first_coordinate);
        std::rotate(orbit.points.begin(), lowest, orbit.points.end());  // clang 14 has no std::ranges::rotate
        for (const Point& point : orbit.points) keep_point(point);
    }

    void keep_peak(Recorder<double>& recorder) {
        if (measures_.force_per_cycle) cycle_peaks_.push_back(recorder.take_recent_force());
    }

    // Mean and 95 % quantile (nearest rank) of the cycles' largest forces.
    void measure_force_per_cycle(CellResult& result) {
        if (cycle_peaks_.empty()) return;
        const std::size_t cycles = cycle_peaks_.size();
        double sum = 0;
        for (const double peak : cycle_peaks_) sum += peak;
        const auto rank = cycle_peaks_.begin() + static_cast<std::ptrdiff_t>((95 * cycles + 99) / 100 - 1);
        std::ranges::nth_element(cycle_peaks_, rank);
        result.peak_force_mean = sum / static_cast<double>(cycles);
        result.peak_force_q95 = std::isnan(sum) ? unknown : *rank;
        result.window_cycles = static_cast<std::int32_t>(cycles);
    }

    // What was recorded over so many cycles.
    void measured(CellResult& result, const Totals<double>& totals, std::int64_t cycles) {
        result.peak_force = totals.peak_force();
        measure_force_per_cycle(result);
        result.largest_displacement = totals.displacement_bound;
        result.chatter = totals.chatter;
        result.impact_rate = static_cast<double>(totals.impacts) / static_cast<double>(cycles);
        if (measures_.detail == trajectory::Detail::force) return;
        result.impact_speed = totals.impact_speed;
        result.impulse = totals.impulse;
        result.contact_time = totals.contact_time;
        result.contact_power = totals.contact_work / (static_cast<double>(cycles) * scene_.period());
        result.max_displacement = totals.largest_displacement;
    }

    // One of the q points names the orbit, whatever start and phase led to it.
    static Point lowest_point(const PeriodicOrbit& orbit) {
        return *std::ranges::min_element(orbit.points, {}, first_coordinate);
    }
    static double first_coordinate(const Point& point) { return point[0]; }

    Task<CellResult> settled(SettledMotion motion, Regime regime) {
        if (measures_.motion != nullptr) keep_settled(motion.point);
        Recorder<double> recorder(measures_.detail);
        if (recorder.records_contacts()) {
            const Passage cycle = co_await map_.cycle(map_.scaled(motion.point), &recorder);
            if (!cycle.ok) co_return failed(cycle.outcome);
        }
        CellResult result = on_orbit(motion.jacobian, 1, motion.point);
        result.regime = regime;
        if (regime == Regime::no_impact) result.last_impact = static_cast<std::int32_t>(last_touched_);
        result.period = 1;
        measured(result, recorder.totals(), 1);
        result.peak_force = motion.peak_force;
        if (measures_.force_per_cycle) {
            result.peak_force_mean = result.peak_force_q95 = motion.peak_force;
            result.window_cycles = 1;
        }
        result.largest_displacement = motion.largest_displacement;
        if (!recorder.records_contacts()) co_return result;
        if (!motion.decays) result.max_displacement = motion.largest_displacement;
        if (regime == Regime::sustained_contact) result.impulse = result.contact_time = unknown;  // no impact
        co_return result;
    }

    void keep_settled(const scene::State<double>& point) {
        measures_.motion->stroboscopic.clear();
        measures_.motion->touches.clear();
        measures_.motion->stroboscopic.add(point);
        measures_.motion->end = point;
    }

    // The values of an attractor that others found, and what this search spent on it.
    CellResult on_known(const CellResult& attractor) {
        const CellResult spent = counted();
        CellResult result = attractor;
        result.cycles = spent.cycles;
        result.sensitivity = spent.sensitivity;
        return result;
    }

    CellResult unproved(Regime regime, Status status) {
        CellResult result = counted();
        result.regime = regime;
        result.status = status;
        window_.finish();
        measured(result, window_.totals(), std::max<std::int64_t>(window_cycles_, 1));
        result.lyapunov = growth_.exponent();
        if (measures_.motion != nullptr) measures_.motion->end = map_.unscaled(state_);
        return result;
    }

    CellResult failed(Cycle<double>::Outcome outcome) {
        CellResult result = counted();
        result.regime = Regime::failed;
        result.status = status_of(outcome);
        result.impact_rate = unknown;
        forget_motion();
        return result;
    }

    void forget_motion() {
        if (measures_.motion != nullptr) *measures_.motion = SteadyMotion(measures_.motion->touches.capacity());
    }

    CellResult on_orbit(const Eigen::Matrix2d& jacobian, std::int64_t period,
                        const scene::State<double>& point) {
        CellResult result = counted();
        result.multiplier = spectral_radius(jacobian);
        if (result.multiplier > 0) result.lyapunov = std::log(result.multiplier) / static_cast<double>(period);
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
    StroboscopicMap map_;
    const AttractorTable::OfOneMap* known_;  // nullptr: none
    Settling settling_;
    Recurrence recurrence_;
    Growth growth_;
    Point state_;  // at the end of the last cycle
    std::optional<ConvergenceTest> test_;
    Recorder<double> window_;          // over the cycles that count for a motion without a period
    std::vector<double> cycle_peaks_;  // of the cycles that count
    std::int64_t window_cycles_ = 0;
    EventPattern pattern_ = 0;
    std::int64_t tested_cycles_ = 0;
    std::int64_t last_touched_ = 0;  // cycle of the trajectory, the first being 1; 0: none
    std::int64_t measure_from_;
    std::int64_t chaos_from_;
    std::int64_t last_cycle_;
    std::span<const Cycle<double>> ahead_;  // integrated, and not looked at yet
    Measures measures_;
    bool looks_at_each_;  // cycle for itself
    bool conservative_;
};

}  // namespace

Task<CellResult> find_steady_state(CycleDesk& desk, scene::Oscillator<double> scene, scene::State<double> start,
                                   Budget budget, EngineSettings engine, Measures measures,
                                   Attractors attractors) {
    Search search(scene, start, budget, engine, measures, attractors.known, desk);
    const CellResult result = co_await search.run();
    if (attractors.found != nullptr) attractors.found->push_back({scene.cubic, engine, result});
    co_return result;
}

CellResult find_steady_state(const scene::Oscillator<double>& scene, const scene::State<double>& start,
                             const Budget& budget, const EngineSettings& engine, Measures measures) {
    CycleDesk desk;
    return complete(find_steady_state(desk, scene, start, budget, engine, measures), desk);
}

}  // namespace peterka::regime
