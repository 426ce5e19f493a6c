#include "regime/solve_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "job/stored_quantities.hpp"
#include "regime/cubic_shift.hpp"
#include "regime/growth.hpp"
#include "regime/lasting_motion_proof.hpp"
#include "regime/orbit_result.hpp"
#include "regime/scalar_engine.hpp"

namespace peterka::regime {

namespace {

// Quantities not requested are not computed. Jumps of a sweep are told by impact speeds where there is no
// force.
Measures measures_of(const job::Job& job) {
    Measures measures;
    const auto impacts =
        job::is_rigid(job.contact) ? trajectory::Detail::impacts : trajectory::Detail::contacts;
    if (job.kind == job::Kind::sweep && job::is_rigid(job.contact)) measures.detail = impacts;
    for (const cell::Quantity& quantity : cell::quantities) {
        const bool takes_more = quantity.recorded != cell::Recorded::usual;  // tested first: most don't
        if (!takes_more || !job::stores(job, quantity)) continue;
        if (quantity.recorded == cell::Recorded::impacts) measures.detail = std::max(measures.detail, impacts);
        if (quantity.recorded == cell::Recorded::contacts) measures.detail = trajectory::Detail::contacts;
        measures.force_per_cycle |= quantity.recorded == cell::Recorded::cycle_forces;
    }
    return measures;
}

// A disturbance of the motion, in A0, that grew to this size may have changed a decision on the way. Of 45,000
// cells of random rigs one was changed by 0.1.
constexpr double harmless = 0.02;

std::int32_t sum_of_cycles(std::int64_t some, std::int64_t more) {
    return static_cast<std::int32_t>(
        std::min<std::int64_t>(some + more, std::numeric_limits<std::int32_t>::max()));
}

// Regimes proved for all future time; in the others, growth above any bound is part of the motion.
bool has_lasting_proof(const CellResult& result) {
    return has_period(result.regime);
}

// Solves one cell, with all the searches needed.
class CellSolver {
  public:
    CellSolver(CycleBroker& broker, const job::Job& job, scene::Cell cell, SearchContext attractors,
               SteadyMotion* motion)
        : broker_(broker),
          cell_(std::move(cell)),
          solver_(job.solver),
          budget_(job.steady_state),
          attractors_(attractors),
          measures_(measures_of(job)) {
        measures_.motion = motion;
    }

    Task<CellResult> run() {
        CellResult result;
        if (may_omit()) {
            result = co_await search(without_cubic(cell_.oscillator), cell_.start, exact());
            if (cell_.oscillator.cubic != 0) result = co_await with_cubic_where_it_matters(result);
        } else {
            result = co_await with_all_terms(EngineSettings{}.largest_displacement, solver_.tolerance);
        }
        if (has_lasting_proof(result) && result.sensitivity > most_sensitive(result))
            result.status = Status::rounding;
        result.cycles = sum_of_cycles(spent_, 0);
        co_return result;
    }

    // The result where the start alone shows that the stop is never met, as in most cells of a map; else
    // nothing.
    [[nodiscard]] std::optional<CellResult> at_once() const {
        if (!may_omit() || measures_.detail > trajectory::Detail::impacts) return std::nullopt;
        const trajectory::FreeFlight<double> flight(without_cubic(cell_.oscillator));
        const auto free = free_for_ever(flight, cell_.start);
        if (!free) return std::nullopt;
        CellResult result;
        result.last_impact = 0;
        result.sensitivity = Growth().sensitivity();
        if (measures_.detail == trajectory::Detail::impacts) {
            result.impact_speed = result.impulse = result.contact_time = result.contact_power = 0;
        }
        write_settled(result, *free, Regime::no_impact, cell_.oscillator.gap, measures_.force_per_cycle);
        const bool stays =
            cell_.oscillator.cubic == 0 || !(must_keep_cubic(result) || may_have_another_label(result));
        return stays ? std::optional(result) : std::nullopt;
    }

  private:
    // Whether the closed form may omit the cubic term, as far as the job and the stop tell.
    [[nodiscard]] bool may_omit() const {
        if (solver_.engine != job::EngineChoice::automatic || has_nonlinear_contact(cell_.oscillator))
            return false;
        return cell_.oscillator.cubic == 0 || solver_.omit_tolerance > 0;
    }

    // The result without the cubic term if the term changes neither the label, nor the peak force by more than
    // is allowed; where rounding or chaos decides, this cannot be known. Otherwise the result with it.
    Task<CellResult> with_cubic_where_it_matters(CellResult without) {
        if (must_keep_cubic(without)) co_return co_await with_all_terms(reach_of(without), solver_.tolerance);
        if (!has_lasting_proof(without)) co_return without;
        if (may_have_another_label(without)) co_return co_await with_cubic_if_it_turns(without);
        if (without.regime != Regime::periodic) co_return without;
        const CubicShift shift = co_await shift_of(without);
        if (shift.change && *shift.change <= solver_.omit_tolerance) co_return without;
        co_return co_await with_fit_errors(reach_of(without), coarse());
    }

    // Searches with the term until errors of the splitting, too, change no decision on the way; each time with
    // as small ones as the last way requires.
    Task<CellResult> with_cubic_if_it_turns(CellResult without) {
        double tolerance = coarse();
        double reach = reach_of(without);
        while (splits(tolerance, reach)) {
            const CellResult with =
                co_await again(cell_.oscillator, cell_.start, {Engine::split, tolerance, reach});
            if (with.sensitivity > rounding_decides) {
                without.sensitivity = with.sensitivity;
                co_return without;
            }
            const double fit = fit_tolerance(with);
            const bool stays = same_label(with, without) && !changes_force(with, without);
            if (stays && fit > tolerance / 2) {
                if (with.sensitivity > most_sensitive(with)) {
                    without.status = Status::rounding;
                    without.sensitivity = with.sensitivity;
                }
                co_return without;
            }
            tolerance = fit;
            reach = reach_of(with);
            if (!stays) break;
        }
        co_return co_await with_fit_errors(reach, tolerance);
    }

    // For a known attractor, the shift was computed when it was found.
    Task<CubicShift> shift_of(CellResult without) {
        const auto* known = attractors_.known != nullptr
                                ? attractors_.known->of(without_cubic(cell_.oscillator), exact())
                                : nullptr;
        if (known != nullptr) {
            if (const auto shift = known->shift_of(without)) co_return *shift;
        }
        const CubicShift shift = co_await shift_by_cubic(broker_, cell_.oscillator,
                                                         {Engine::split, coarse(), reach_of(without)}, without);
        spent_ += shift.cycles;
        // the search without the term was the last one
        if (attractors_.found != nullptr && !attractors_.found->empty())
            attractors_.found->back().by_cubic = shift;
        co_return shift;
    }

    // Whether the term is too strong to be omitted, or to be examined with `split`.
    [[nodiscard]] bool must_keep_cubic(const CellResult& without) const {
        return !(effect_of_cubic(cell_.oscillator, without.largest_displacement) <= solver_.omit_tolerance) ||
               !splits(coarse(), EngineSettings{}.largest_displacement);
    }
    // For a cell with a lasting proof.
    [[nodiscard]] bool may_have_another_label(const CellResult& without) const {
        const double effect = effect_of_cubic(cell_.oscillator, without.largest_displacement);
        // How far the term moves the motion in a few cycles; exp(sensitivity) is the growth of that. On a way
        // with impacts, it went as far as the stop at least.
        const double stop = without.last_impact != 0 ? std::abs(cell_.oscillator.gap) : 0;
        const double reach = std::max(without.largest_displacement, stop);
        const double disturbance =
            4 * effect_of_cubic(cell_.oscillator, reach) / 3 * reach * cell_.oscillator.period();
        const bool may_turn =
            disturbance * std::exp(without.sensitivity) > harmless && without.sensitivity <= rounding_decides;
        return may_turn || is_near_its_edge(without, effect);
    }

    // Or, on a rigid stop, the largest impact speed, if it is known.
    [[nodiscard]] bool changes_force(const CellResult& with, const CellResult& without) const {
        const bool has_force = !std::isnan(without.peak_force);
        const double before = has_force ? without.peak_force : without.impact_speed;
        const double after = has_force ? with.peak_force : with.impact_speed;
        if (with.regime == Regime::no_impact || std::isnan(before)) return false;
        return !(std::abs(after / before - 1) <= solver_.omit_tolerance);
    }

    // Keeps every term, in a search with this tolerance; an orbit found is refined to the requested one. The
    // engine and its steps depend on the largest displacement.
    Task<CellResult> with_all_terms(double largest_displacement, double tolerance) {
        EngineByReach engine(cell_.oscillator, solver_, largest_displacement, tolerance);
        CellResult result;
        do {
            result = co_await search(cell_.oscillator, cell_.start, engine.settings());
        } while (engine.must_change(result.largest_displacement));
        co_return result;
    }

    // The same with a tolerance at which errors of the search change no decision on its way, as far as
    // solver.tolerance allows.
    Task<CellResult> with_fit_errors(double largest_displacement, double tolerance) {
        CellResult result = co_await with_all_terms(largest_displacement, tolerance);
        while (result.engine == Engine::split && fit_tolerance(result) <= tolerance / 2) {
            tolerance = fit_tolerance(result);
            result = co_await with_all_terms(reach_of(result), tolerance);
        }
        co_return result;
    }

    // Above this sensitivity errors may have decided: those of rounding, or those that the tolerance allows
    // kicks and integrators.
    [[nodiscard]] double most_sensitive(const CellResult& found) const {
        if (found.engine == Engine::exact) return rounding_decides;
        return std::min(rounding_decides, std::log(harmless / solver_.tolerance));
    }

    // Tolerance of a search whose errors grow as in this one, so that they change no decision on its way.
    [[nodiscard]] double fit_tolerance(const CellResult& found) const {
        if (!has_lasting_proof(found) || found.sensitivity > rounding_decides) return coarse();
        return std::clamp(harmless * std::exp(-found.sensitivity), solver_.tolerance, coarse());
    }

    // Whether a cell that ends without a contact, or in a permanent one, may end otherwise with the cubic term.
    // Omitting it is a disturbance of at most effect/3 times the motion, and the response to a bounded
    // disturbance is at most `gain` times that (regime/lasting_motion_proof.hpp).
    [[nodiscard]] bool is_near_its_edge(const CellResult& without, double effect) const {
        if (without.regime == Regime::periodic) return false;
        if (without.regime == Regime::sustained_contact) {
            return effect / (1 - without.multiplier) > solver_.omit_tolerance;
        }
        const double loop = effect * gain(cell_.oscillator.damping_ratio);
        const double reach = without.largest_displacement;
        return !(loop < 1) || reach * (1 + loop / 3 / (1 - loop)) >= cell_.oscillator.gap;
    }

    [[nodiscard]] EngineSettings exact() const { return {.tolerance = solver_.tolerance}; }
    // Tolerance to judge the term's effect, not to solve with it.
    [[nodiscard]] double coarse() const { return std::max(solver_.tolerance, solver_.omit_tolerance / 30); }
    // Whether the closed form with kicks can follow a motion of this reach with this tolerance.
    [[nodiscard]] bool splits(double tolerance, double largest_displacement) const {
        job::Solver solver = solver_;
        solver.tolerance = tolerance;
        const EngineByReach with(cell_.oscillator, solver, largest_displacement);
        return with.settings().engine == Engine::split;
    }
    // How far a search for the motion may go, including its transient.
    static double reach_of(const CellResult& result) {
        const double usual = EngineSettings{}.largest_displacement;
        return std::isfinite(result.largest_displacement) ? std::max(usual, result.largest_displacement)
                                                          : usual;
    }

    Task<CellResult> search(scene::Oscillator<double> oscillator, scene::State<double> start,
                            EngineSettings engine) {
        engine.orbit_tolerance = solver_.tolerance;
        const CellResult result =
            co_await find_steady_state(broker_, oscillator, start, budget_, engine, measures_, attractors_);
        spent_ += result.cycles;
        co_return result;
    }
    // For its label and its peak force or, if requested, on a rigid stop, impact speed. Gives up where rounding
    // begins to decide.
    Task<CellResult> again(scene::Oscillator<double> oscillator, scene::State<double> start,
                           EngineSettings engine) {
        const CellResult result =
            co_await find_steady_state(broker_, oscillator, start, budget_, engine,
                                       {.detail = std::min(measures_.detail, trajectory::Detail::impacts)},
                                       {attractors_.known, attractors_.found}, rounding_decides);
        spent_ += result.cycles;
        co_return result;
    }

    CycleBroker& broker_;
    scene::Cell cell_;
    job::Solver solver_;
    job::SteadyState budget_;
    SearchContext attractors_;
    Measures measures_;
    std::int64_t spent_ = 0;
};

}  // namespace

Task<SearchOutcome> search_cell(CycleBroker& broker, const job::Job& job, scene::Cell cell,
                                SearchContext attractors) {
    std::vector<FoundAttractor> found;
    attractors.found = &found;
    SearchOutcome outcome = co_await outcome_of(solve_cell(broker, job, std::move(cell), attractors));
    outcome.found = std::move(found);
    co_return outcome;
}

CellResult solve_again(const scene::Scene& scene, std::int64_t row, std::int64_t column, Engine first_engine) {
    return solve_again(scene.job(), scene.cell(row, column), first_engine);
}

CellResult solve_again(const job::Job& job, const scene::Cell& cell, Engine first_engine) {
    constexpr double coarsest = 1e-8;  // of a check
    const Engine cheaper = cheaper_integrator(cell.oscillator);
    const Engine other = cheaper == Engine::cvode ? Engine::arkode : Engine::cvode;
    return find_steady_state(cell.oscillator, cell.start, job.steady_state,
                             {.engine = cheaper == first_engine ? other : cheaper,
                              .tolerance = std::clamp(job.solver.tolerance, finest_of_integrators, coarsest)});
}

std::optional<CellResult> solve_at_once(const job::Job& job, const scene::Cell& cell) {
    CycleBroker broker;
    return CellSolver(broker, job, cell, {}, nullptr).at_once();
}

Task<CellResult> solve_cell(CycleBroker& broker, const scene::Scene& scene, std::int64_t row,
                            std::int64_t column, SearchContext attractors) {
    return solve_cell(broker, scene.job(), scene.cell(row, column), attractors);
}

Task<CellResult> solve_cell(CycleBroker& broker, const job::Job& job, scene::Cell cell,
                            SearchContext attractors, SteadyMotion* motion) {
    CellSolver solution(broker, job, std::move(cell), attractors, motion);
    co_return co_await solution.run();
}

CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    CycleBroker broker;
    return complete(solve_cell(broker, scene, row, column), broker);
}

}  // namespace peterka::regime
