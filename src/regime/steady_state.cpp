#include "regime/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "regime/chaos_claim.hpp"
#include "regime/failed_cycle.hpp"
#include "regime/followed_trajectory.hpp"
#include "regime/growth.hpp"
#include "regime/lasting_motion_proof.hpp"
#include "regime/orbit_measurement.hpp"
#include "regime/orbit_result.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/recurrence.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::regime {

namespace {

using trajectory::Cycle;

class Search {
  public:
    Search(const scene::Oscillator<double>& oscillator, const scene::State<double>& start,
           const job::SteadyState& budget, const EngineSettings& engine, const Measures& measures,
           const SearchContext& attractors, double most_growth, CycleBroker& broker)
        : map_(oscillator, engine, broker),
          known_(attractors.known != nullptr ? attractors.known->of(oscillator, engine) : nullptr),
          knows_chaos_(attractors.chaos),
          conservative_(scene::is_conservative(oscillator)),
          trajectory_(map_, start, budget,
                      conservative_ ? std::min(budget.chaos_cycles, budget.max_cycles) : budget.max_cycles,
                      measures),
          settling_(map_),
          recurrence_(budget.max_period, oscillator.cubic != 0),
          budget_(budget),
          longest_orbit_near_(std::min(ChaosClaim::longest_orbit_near, budget.max_period)),
          most_growth_(most_growth),
          measures_(measures),
          log_(measures.motion) {
        log_.forget();
    }

    Task<CellResult> run() {
        for (;;) {
            if (trajectory_.is_to_be_looked_at()) {
                const auto state = map_.unscaled(trajectory_.state());
                if (const auto free = settling_.stays_free(state)) {
                    co_return co_await settled(*free, Regime::no_impact);
                }
                if (const auto contact = settling_.stays_in_contact(state)) {
                    co_return co_await settled(*contact, Regime::sustained_contact);
                }
                if (trajectory_.is_at_checkpoint() && !conservative_) {
                    note_what_is_forgotten();
                    if (grew_too_much()) co_return unproved(Regime::unresolved, Status::budget);
                    if (joins_chaos()) co_return unproved(Regime::chaotic, Status::verified);
                    if (const std::int64_t q = test_ ? 0 : recurrence_.candidate(); q > 0) {
                        if (const CellResult* attractor = orbit_reached(q)) co_return on_known(*attractor);
                        if (!test_) {
                            trajectory_.keep_ordered();
                            const auto orbit = co_await find_stable_orbit(map_, recurrence_, q);
                            if (const auto result = co_await converged(orbit)) co_return *result;
                        }
                    }
                    if (is_chaotic()) {
                        if (!chaos_->asks_for_orbits(growth_))
                            co_return unproved(Regime::chaotic, Status::verified);
                        if (co_await is_stable_orbit_near(map_, recurrence_, longest_orbit_near_))
                            chaos_->wait_beside_an_orbit();
                    }
                }
            }
            if (const CellResult* attractor = attractor_reached()) co_return on_known(*attractor);
            if (trajectory_.needs_order()) {
                if (trajectory_.is_at_end()) co_return unproved(Regime::unresolved, why_unresolved());
                trajectory_.take(co_await trajectory_.order(map_));
            }
            const OrderedCycles followed = follow_ordered();
            if (followed.outcome != Cycle<double>::Outcome::done) co_return failed(followed.outcome);
            if (followed.converged) {
                if (converges_to_ != nullptr) co_return on_known(*converges_to_);
                trajectory_.keep_ordered();
                if (const auto result = co_await periodic(test_->orbit())) co_return *result;
                test_.reset();
            }
        }
    }

  private:
    struct OrderedCycles {
        Cycle<double>::Outcome outcome = Cycle<double>::Outcome::done;
        bool converged = false;
    };
    // Follows the ordered cycles, up to the first one that may end the search. Separate from run(): a long
    // search spends its time in this loop.
    OrderedCycles follow_ordered() {
        do {
            const CycleResult cycle = trajectory_.advance(map_);
            if (!cycle.ok) return {.outcome = cycle.outcome};
            growth_.advance(cycle.jacobian);
            if (conservative_) continue;  // no recurrence persists
            recurrence_.record(cycle);
            if (test_ && converges(cycle)) return {.converged = true};
        } while (!trajectory_.is_to_be_looked_at() && attractor_reached() == nullptr);
        return {};
    }
    [[nodiscard]] const CellResult* attractor_reached() const {
        return known_ != nullptr ? known_->reached_from(trajectory_.state()) : nullptr;
    }
    void note_what_is_forgotten() {
        if (forgot_after_ == 0 && growth_.sensitivity() > rounding_decides)
            forgot_after_ = trajectory_.cycles();
    }
    [[nodiscard]] bool grew_too_much() const {
        return most_growth_ < std::numeric_limits<double>::infinity() && growth_.sensitivity() > most_growth_;
    }
    [[nodiscard]] bool joins_chaos() const {
        return knows_chaos_ && trajectory_.cycles() >= SearchContext::cycles_to_settle &&
               growth_.sensitivity() > rounding_decides;
    }
    [[nodiscard]] bool is_chaotic() {
        if (!ChaosClaim::looks_chaotic(growth_)) return false;
        if (!chaos_) chaos_.emplace(budget_, settling_.may_settle());  // which may have to look for an orbit
        return chaos_->lasted_long_enough(growth_, trajectory_.cycles());
    }
    [[nodiscard]] Status why_unresolved() const {
        if (conservative_) return Status::conservative;
        return ChaosClaim::looks_chaotic(growth_) ? Status::chaotic_so_far : Status::budget;
    }

    // The known attractor to which a trajectory that recurs after q cycles was shown to converge. If one is
    // merely near, the test continues.
    const CellResult* orbit_reached(std::int64_t q) {
        if (known_ == nullptr || was_near_in_vain_) return nullptr;
        const auto near = known_->orbit_near(recurrence_.state(), q);
        if (!near) return nullptr;
        TestOfPast past = test_of_past(recurrence_, near->orbit, map_.noise());
        if (past.standing == ConvergenceTest::Standing::proved) return near->attractor;
        test_ = std::move(past.test);
        converges_to_ = near->attractor;
        return nullptr;
    }

    // The cycles already followed may be proof enough.
    Task<std::optional<CellResult>> converged(std::optional<PeriodicOrbit> orbit) {
        if (!orbit) co_return std::nullopt;
        TestOfPast past = test_of_past(recurrence_, *orbit, map_.noise());
        if (past.standing == ConvergenceTest::Standing::proved) co_return co_await periodic(std::move(*orbit));
        test_ = std::move(past.test);
        converges_to_ = nullptr;
        co_return std::nullopt;
    }
    // Whether the trajectory is proved to converge to the orbit found.
    bool converges(const CycleResult& last_cycle) {
        const auto standing = test_->follow(last_cycle);
        if (standing == ConvergenceTest::Standing::refuted) {
            test_.reset();
            was_near_in_vain_ = was_near_in_vain_ || converges_to_ != nullptr;
        }
        return standing == ConvergenceTest::Standing::proved;
    }

    // None if the orbit proves to be unstable, or to have other contacts than those seen.
    Task<std::optional<CellResult>> periodic(PeriodicOrbit orbit) {
        const double tolerance = map_.settings().tolerance;
        if (map_.settings().orbit_tolerance < tolerance) {
            map_.set_tolerance(map_.settings().orbit_tolerance);
            orbit.error = 1;  // computed for a different map
        }
        const double orbit_tolerance = map_.settings().tolerance;
        const std::size_t first = put_lowest_point_first(orbit);
        const std::size_t reached = (orbit.points.size() - first) % orbit.points.size();  // where it was found
        Observation observation(measures_, map_.oscillator().period());
        MeasuredOrbit measured = co_await measure_orbit(map_, orbit, observation);
        if (measured.outcome != Cycle<double>::Outcome::done) co_return failed(measured.outcome);
        if (measured.round.pattern(reached) != orbit.pattern || !is_stable(orbit)) {
            map_.set_tolerance(tolerance);
            co_return std::nullopt;
        }
        const auto& totals = observation.totals();
        double off = 0;  // what its force may be off by
        if (map_.noise() > 0 && measured.round.touched() && measured.round.separated()) {
            off = co_await measure_sharply(orbit, observation, measured, reached);
            if (measured.outcome != Cycle<double>::Outcome::done) co_return failed(measured.outcome);
        }
        if (!measured.round.touched() || !measured.round.separated()) {
            const SettledMotion motion{map_.unscaled(orbit.points[reached]), orbit.jacobian,
                                       totals.peak_force(), totals.displacement_bound};
            co_return co_await settled(
                motion, measured.round.touched() ? Regime::sustained_contact : Regime::no_impact);
        }
        if (log_.is_wanted()) log_.settle_on(map_.unscaled(orbit.points), reached);
        CellResult result = counted();
        result.regime = Regime::periodic;
        result.impacts = static_cast<std::int32_t>(totals.impacts);
        write_orbit(result, orbit.jacobian, orbit.period(), map_.unscaled(orbit.point()),
                    map_.oscillator().gap);
        observation.write_to(result);
        if (std::max(off, force_error(map_, orbit, measured.round, result.peak_force)) > orbit_tolerance) {
            result.status = Status::imprecise;
        }
        co_return result;
    }

    // Measures an orbit that an integrator has found, and measured, again with a tolerance so much smaller that
    // the difference is the error of the first: local errors may grow from cycle to cycle, and a stiff
    // contact's force is not as exact as the motion. Returns a relative error of the peak force, which is
    // unknown, and so infinite, where the integrator fails with that tolerance or finds another motion: then it
    // is measured as before.
    Task<double> measure_sharply(PeriodicOrbit& orbit, Observation& observation, MeasuredOrbit& measured,
                                 std::size_t reached) {
        constexpr double sharper = 0.01;
        constexpr double least_gain = 0.1;  // by which errors become smaller, at least
        const double force = observation.totals().peak_force();
        const double tolerance = map_.settings().tolerance;
        const double sharp_tolerance = std::max(sharper * tolerance, finest_of_integrators);
        map_.set_tolerance(sharp_tolerance);
        PeriodicOrbit again = orbit;
        again.error = 1;
        const MeasuredOrbit sharp = co_await measure_orbit(map_, again, observation);
        if (sharp.outcome == Cycle<double>::Outcome::done && sharp.round.pattern(reached) == orbit.pattern &&
            is_stable(again)) {
            orbit = std::move(again);
            measured = sharp;
            const double gain = std::max(least_gain, sharp_tolerance / tolerance);
            co_return std::abs(observation.totals().peak_force() / force - 1) * gain;
        }
        map_.set_tolerance(tolerance);
        orbit.error = 1;
        observation = Observation(measures_, map_.oscillator().period());  // without what the failure left open
        measured = co_await measure_orbit(map_, orbit, observation);
        co_return std::numeric_limits<double>::infinity();
    }

    Task<CellResult> settled(SettledMotion motion, Regime regime) {
        log_.settle_on({&motion.point, 1}, 0);
        log_.forget_touches();
        Observation observation({.detail = measures_.detail}, map_.oscillator().period());
        const bool records_contacts = observation.recorder().records_contacts();
        if (records_contacts) {
            const CycleResult cycle = co_await map_.cycle(map_.scaled(motion.point), &observation.recorder());
            if (!cycle.ok) co_return failed(cycle.outcome);
            observation.end_cycle();
        }
        CellResult result = counted();
        if (regime == Regime::no_impact)
            result.last_impact = static_cast<std::int32_t>(trajectory_.last_touched());
        observation.write_to(result);
        write_settled(result, motion, regime, map_.oscillator().gap, measures_.force_per_cycle);
        if (records_contacts && !motion.decays) result.max_displacement = motion.largest_displacement;
        if (regime == Regime::sustained_contact) result.impulse = result.contact_time = unknown;  // no impact
        co_return result;
    }

    // The values of a known attractor, with what this search spent.
    CellResult on_known(const CellResult& attractor) {
        const CellResult spent = counted();
        CellResult result = attractor;
        result.cycles = spent.cycles;
        result.sensitivity = spent.sensitivity;
        result.followed_cycles = spent.followed_cycles;
        result.forgot_after = spent.forgot_after;
        return result;
    }

    CellResult unproved(Regime regime, Status status) {
        CellResult result = counted();
        result.regime = regime;
        result.status = status;
        trajectory_.window().finish();
        trajectory_.window().write_to(result);
        result.lyapunov = growth_.exponent();
        result.observed_cycles = static_cast<std::int32_t>(trajectory_.cycles());
        log_.end_at(map_.unscaled(trajectory_.state()));
        return result;
    }

    CellResult failed(Cycle<double>::Outcome outcome) {
        CellResult result = counted();
        result.regime = Regime::failed;
        result.status = status_of(outcome);
        result.impact_rate = unknown;
        log_.forget();
        return result;
    }

    CellResult counted() {
        CellResult result;
        result.engine = map_.engine();
        result.cycles = static_cast<std::int32_t>(std::min<std::int64_t>(
            map_.cycles_spent() - trajectory_.not_needed(), std::numeric_limits<std::int32_t>::max()));
        result.sensitivity = growth_.sensitivity();
        result.followed_cycles = static_cast<std::int32_t>(trajectory_.cycles());
        result.forgot_after = static_cast<std::int32_t>(forgot_after_);
        return result;
    }

    StroboscopicMap map_;
    const AttractorTable::AttractorsOfMap* known_;  // nullptr: none
    bool knows_chaos_;
    bool conservative_;
    std::int64_t forgot_after_ = 0;  // cycles; 0: not yet
    FollowedTrajectory trajectory_;
    LastingMotionProof settling_;
    Recurrence recurrence_;
    Growth growth_;
    job::SteadyState budget_;
    std::optional<ChaosClaim> chaos_;  // since the motion looks chaotic
    std::int64_t longest_orbit_near_;
    std::optional<ConvergenceTest> test_;
    const CellResult* converges_to_ = nullptr;  // the attractor of the test's orbit, if it is a known one
    bool was_near_in_vain_ = false;
    double most_growth_;
    Measures measures_;
    MotionLog log_;
};

}  // namespace

Task<CellResult> find_steady_state(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                   scene::State<double> start, job::SteadyState budget, EngineSettings engine,
                                   Measures measures, SearchContext attractors, double most_growth) {
    Search search(oscillator, start, budget, engine, measures, attractors, most_growth, broker);
    const CellResult result = co_await search.run();
    if (attractors.found != nullptr) attractors.found->push_back({oscillator.cubic, engine, result});
    co_return result;
}

CellResult find_steady_state(const scene::Oscillator<double>& oscillator, const scene::State<double>& start,
                             const job::SteadyState& budget, const EngineSettings& engine, Measures measures) {
    CycleBroker broker;
    return complete(find_steady_state(broker, oscillator, start, budget, engine, measures), broker);
}

}  // namespace peterka::regime
