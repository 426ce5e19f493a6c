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
          settles_(settling_.may_settle()),
          chaos_from_(settles_ ? budget.chaos_cycles : budget.fewest_chaos_cycles()),
          last_cycle_(is_conservative(scene) ? std::min(budget.chaos_cycles, budget.max_cycles)
                                             : budget.max_cycles),
          budget_(budget),
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
                if (cycle == last_cycle_) co_return unproved(Regime::unresolved, why_unresolved());
                ahead_ = co_await map_.cycles(state_, counts ? &window_ : nullptr, order_from(cycle));
            }
            const Passage passage = map_.passage(ahead_.front());
            ahead_ = ahead_.subspan(1);
            if (!passage.ok) co_return failed(passage.outcome);
            state_ = passage.end;
            followed_ = cycle + 1;
            if (passage.touched) last_touched_ = cycle + 1;
            growth_.advance(passage.jacobian);
            if (counts) {
                ++window_cycles_;
                keep_peak(window_);
                keep_point(state_);
            }

            if (conservative_) continue;  // nothing recurs for good
            recurrence_.record(passage);
            if (test_ && converges(passage)) {
                // what it orders meanwhile takes the place of what was ordered ahead
                kept_.assign(ahead_.begin(), ahead_.end());
                ahead_ = kept_;
                if (const auto result = co_await periodic(test_->orbit())) co_return *result;
                test_.reset();
            }
            if (!is_stop(cycle + 1)) continue;
            if (budget_.most_growth < std::numeric_limits<double>::infinity() &&
                growth_.sensitivity() > budget_.most_growth) {
                co_return unproved(Regime::unresolved, Status::budget);
            }
            if (const std::int64_t q = test_ ? 0 : recurrence_.candidate(); q > 0) {
                const auto orbit = co_await find_stable_orbit(map_, recurrence_, q);
                if (orbit && converged(*orbit)) {
                    if (const auto result = co_await periodic(*orbit)) co_return *result;
                }
            }
            if (looks_chaotic() && static_cast<double>(cycle + 1) >= fewest_chaos_cycles()) {
                if (searched_orbits_ || settles_ || growth_.dissipation() > forgets_at_once) {
                    co_return unproved(Regime::chaotic, Status::proved);
                }
                searched_orbits_ = true;
                if (co_await is_stable_orbit_near()) patience_ = patience_beside_an_orbit;
            }
        }
    }

  private:
    // Lives of chaotic transients go with the time in which areas shrink, and are scattered over decades: of
    // 2,200 chaotic cells of 45 random rigs with damping ratios from 0.002 to 0.05 and restitutions from 0.25
    // to 0.97 5 % settled between 600 such times and 20,000 cycles, two thirds of them on orbits of period 1
    // to 4.
    static constexpr double chaos_areas = 2.0;      // e-foldings of the area in each of the fewest chaos cycles
    static constexpr double forgets_at_once = 1.2;  // per cycle; where more is lost few settle later
    static constexpr double patience_beside_an_orbit = 4;
    static constexpr std::int64_t longest_orbit_near = 4;

    // After two resets it repeats, be it with a period beyond max_period, however wild it looks.
    [[nodiscard]] bool looks_chaotic() const { return growth_.resets() <= 1 && growth_.surely_positive(); }
    // How long chaos has to last, in this scene, until it is called so.
    [[nodiscard]] double fewest_chaos_cycles() const {
        const auto forever = static_cast<double>(budget_.fewest_chaos_cycles());
        return patience_ *
               std::max(static_cast<double>(chaos_from_), forever * chaos_areas / growth_.dissipation());
    }
    [[nodiscard]] Status why_unresolved() const {
        if (conservative_) return Status::conservative;
        return looks_chaotic() ? Status::chaotic_so_far : Status::budget;
    }
    // Whether there is a stable orbit on which the chaos may still end: sought from where the trajectory nearly
    // closed.
    Task<bool> is_stable_orbit_near() {
        for (std::int64_t q = 1; q <= std::min(longest_orbit_near, budget_.max_period); ++q) {
            const auto orbit = co_await find_orbit(map_, recurrence_.closed(q, recurrence_.closest_return(q)));
            if (orbit && is_stable(*orbit)) co_return true;
        }
        co_return false;
    }

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
        const std::int64_t q = orbit.period();
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
        if (++tested_cycles_ < test_->orbit().period()) return false;
        const auto verdict = test_->advance(state_, pattern_);
        tested_cycles_ = 0;
        pattern_ = 0;
        if (verdict == ConvergenceTest::Verdict::refuted) test_.reset();
        return verdict == ConvergenceTest::Verdict::proved;
    }

    // None where the orbit turns out not to be stable after all, or not to have the contacts that were seen.
    Task<std::optional<CellResult>> periodic(PeriodicOrbit orbit) {
        Recorder<double> recorder(measures_.detail, touch_log(measures_));
        const double tolerance = map_.settings().tolerance;
        if (map_.settings().orbit_tolerance < tolerance) {
            map_.set_tolerance(map_.settings().orbit_tolerance);
            orbit.error = 1;  // it is one of another map
        }
        const std::size_t first = from_lowest_point(orbit);
        const std::size_t reached = (orbit.points.size() - first) % orbit.points.size();  // where it was found
        const Recorded recorded = co_await record_period(orbit, recorder);
        if (recorded.outcome != Cycle<double>::Outcome::done) co_return failed(recorded.outcome);
        if (recorded.round.pattern(reached) != orbit.pattern || !is_stable(orbit)) {
            map_.set_tolerance(tolerance);
            co_return std::nullopt;
        }
        const Point& here = orbit.points[reached];
        const Totals<double>& totals = recorder.totals();
        if (!recorded.round.touched() || !recorded.round.separated()) {
            const SettledMotion motion{map_.unscaled(here), orbit.jacobian, totals.peak_force(),
                                       totals.displacement_bound};
            co_return co_await settled(
                motion, recorded.round.touched() ? Regime::sustained_contact : Regime::no_impact);
        }
        if (measures_.motion != nullptr) keep_orbit(orbit, here);
        CellResult result = on_orbit(orbit.jacobian, orbit.period(), map_.unscaled(orbit.point()));
        result.regime = Regime::periodic;
        result.impacts = static_cast<std::int32_t>(totals.impacts);
        result.period = static_cast<std::int32_t>(orbit.period());
        measured(result, totals, orbit.period());
        if (force_error(orbit, recorded.round, totals.peak_force()) > map_.settings().tolerance) {
            result.status = Status::imprecise;
        }
        co_return result;
    }

    // One of the q points names the orbit, whatever start and phase led to it: the lowest, and of those that
    // are alike the slowest. It comes first from now on; how many points came before it.
    static std::size_t from_lowest_point(PeriodicOrbit& orbit) {
        constexpr double alike = 1e-6;
        std::vector<Point>& points = orbit.points;
        double lowest = points.front()[0];
        for (const Point& point : points) lowest = std::min(lowest, point[0]);
        auto first = points.end();
        for (auto point = points.begin(); point != points.end(); ++point) {
            if ((*point)[0] > lowest + alike * magnitude(*point)) continue;
            if (first == points.end() || (*point)[1] < (*first)[1]) first = point;
        }
        const std::ptrdiff_t before = first - points.begin();
        std::rotate(points.begin(), first, points.end());  // clang 14 has no std::ranges::rotate
        return static_cast<std::size_t>(before);
    }

    // What a round of cycles along an orbit showed.
    struct Recorded {
        OrbitRound round;
        Cycle<double>::Outcome outcome = Cycle<double>::Outcome::done;  // of the first cycle that failed
    };

    // One period of an orbit, again for as long as Newton's method still moves its points. What is open at its
    // start counts in full at its end, as in every later period.
    Task<Recorded> record_period(PeriodicOrbit& orbit, Recorder<double>& recorder) {
        constexpr int most_rounds = 6;
        constexpr double at_rest = 1e-13;  // a move, relative, that changes no digit that is told
        const std::size_t q = orbit.points.size();
        bool was_open = false;
        for (int n = 0;; ++n) {
            recorder.reset_totals();
            cycle_peaks_.clear();
            OrbitRound round(orbit.period());
            for (std::size_t point = 0; point < q; ++point) {
                const Passage cycle = co_await map_.cycle(orbit.points[point], &recorder);
                if (!cycle.ok) co_return Recorded{round, cycle.outcome};
                round.add(cycle, orbit.points[(point + 1) % q]);
                keep_peak(recorder);
            }
            const bool opens = recorder.is_open() && !was_open;
            was_open = recorder.is_open();
            orbit.jacobian = round.jacobian();
            orbit.multiplier = spectral_radius(orbit.jacobian);
            std::vector<Point> moved = orbit.points;
            const double last = orbit.error;
            orbit.error = round.correct(moved).value_or(1);
            const bool rests = orbit.error < std::max(at_rest, map_.noise()) || orbit.error > last / 2;
            if ((rests && !opens) || n == most_rounds) co_return Recorded{round};
            if (!rests) orbit.points = std::move(moved);
        }
    }

    // About how far the peak force may be off, relative: what is left of Newton's moves, grown within a cycle,
    // is an error of the speed of an impact, and the force of a spring and dashpot follows that.
    [[nodiscard]] double force_error(const PeriodicOrbit& orbit, const OrbitRound& round, double force) const {
        const auto* stop = std::get_if<scene::KelvinVoigt<double>>(&scene_.contact);
        if (stop == nullptr || map_.noise() > 0) return 0;
        double largest = 0;
        for (const Point& point : orbit.points) {
            largest = std::max(largest, map_.unscaled(Point(Point::Constant(magnitude(point)))).maxCoeff());
        }
        const double speed_error = orbit.error * round.largest_stretch() * largest;
        return speed_error * std::max(stop->damping, std::sqrt(stop->stiffness)) / force;
    }

    static Latest<trajectory::Touch<double>>* touch_log(const Measures& measures) {
        return measures.motion == nullptr ? nullptr : &measures.motion->touches;
    }

    void keep_point(const Point& point) {
        if (measures_.motion != nullptr) measures_.motion->stroboscopic.add(map_.unscaled(point));
    }

    // here: the point that the trajectory is close to at its end.
    void keep_orbit(const PeriodicOrbit& orbit, const Point& here) {
        measures_.motion->stroboscopic.clear();
        measures_.motion->end = map_.unscaled(here);
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
        result.observed_cycles = static_cast<std::int32_t>(followed_);
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
    std::int64_t followed_ = 0;      // cycles of the trajectory
    std::int64_t last_touched_ = 0;  // cycle of the trajectory, the first being 1; 0: none
    std::int64_t measure_from_;
    bool settles_;  // a motion without end may settle after all, as far as is known
    std::int64_t chaos_from_;
    double patience_ = 1;
    bool searched_orbits_ = false;
    std::int64_t last_cycle_;
    std::span<const Cycle<double>> ahead_;  // integrated, and not looked at yet
    std::vector<Cycle<double>> kept_;       // a copy of these, where others are ordered before they are
    Budget budget_;
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
