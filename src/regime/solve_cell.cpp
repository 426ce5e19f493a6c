#include "regime/solve_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regime/cubic_shift.hpp"
#include "regime/scalar_engine.hpp"

namespace peterka::regime {

Budget budget_of(const job::SteadyState& steady) {
    return {
        .max_cycles = steady.max_cycles, .max_period = steady.max_period, .chaos_cycles = steady.chaos_cycles};
}

namespace {

// Not asked for, not computed.
Measures measures_of(const job::Output& output) {
    using job::OptionalField;
    const bool impacts = output.has(OptionalField::impact_speed) || output.has(OptionalField::impulse) ||
                         output.has(OptionalField::contact_time) || output.has(OptionalField::contact_power) ||
                         output.has(OptionalField::max_displacement);
    return {impacts ? trajectory::Detail::contacts : trajectory::Detail::force,
            output.has(OptionalField::force_per_cycle)};
}

// What leaving the cubic term out may have changed in the peak force. Next to a bifurcation an orbit moves by
// about 1/(1 - |multiplier|) times as much as elsewhere; where this bound says too much, shift_by_cubic tells.
double change_without_cubic(const scene::Oscillator<double>& scene, const CellResult& without) {
    const double effect = effect_of_cubic(scene, without.largest_displacement);
    return without.regime == Regime::periodic ? effect / (1 - without.multiplier) : effect;
}

std::int32_t sum_of_cycles(std::int64_t some, std::int64_t more) {
    return static_cast<std::int32_t>(
        std::min<std::int64_t>(some + more, std::numeric_limits<std::int32_t>::max()));
}

// Keeps every term. The engine and its steps hang on the largest displacement; where the result goes
// further than was assumed, it is solved again.
Task<CellResult> solve_with_cubic(CycleDesk& desk, const scene::Cell& cell, const job::Solver& solver,
                                  const Budget& budget, double largest_displacement, Measures measures,
                                  Attractors attractors) {
    constexpr int most_rounds = 3;
    CellResult result;
    std::int32_t cycles = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const EngineSettings engine = engine_with_cubic(cell.oscillator, solver, largest_displacement);
        result =
            co_await find_steady_state(desk, cell.oscillator, cell.start, budget, engine, measures, attractors);
        result.cycles = cycles = sum_of_cycles(cycles, result.cycles);
        if (!goes_too_far(engine, result.largest_displacement)) break;
        largest_displacement = result.largest_displacement;
    }
    co_return result;
}

}  // namespace

CellResult solve_again(const scene::Scene& scene, std::int64_t row, std::int64_t column, Engine first_engine) {
    constexpr double finest = 1e-12;   // of an integrator
    constexpr double coarsest = 1e-8;  // of a check
    const scene::Cell cell = scene.cell(row, column);
    const Engine cheaper = cheaper_integrator(cell.oscillator);
    const Engine other = cheaper == Engine::cvode ? Engine::arkode : Engine::cvode;
    return find_steady_state(cell.oscillator, cell.start, budget_of(scene.job().steady_state),
                             {.engine = cheaper == first_engine ? other : cheaper,
                              .tolerance = std::clamp(scene.job().solver.tolerance, finest, coarsest)});
}

Task<CellResult> solve_cell(CycleDesk& desk, const scene::Scene& scene, std::int64_t row, std::int64_t column,
                            Attractors attractors) {
    return solve_cell(desk, scene.job(), scene.cell(row, column), attractors);
}

Task<CellResult> solve_cell(CycleDesk& desk, const job::Job& job, scene::Cell cell, Attractors attractors,
                            SteadyMotion* motion) {
    const job::Solver& solver = job.solver;
    const Budget budget = budget_of(job.steady_state);
    Measures measures = measures_of(job.output);
    measures.motion = motion;
    const bool automatic = solver.engine == job::EngineChoice::automatic;
    const bool is_linear = cell.oscillator.cubic == 0;
    const bool keeps_all = (!is_linear && solver.omit_tolerance == 0) || has_nonlinear_contact(cell.oscillator);
    if (!automatic || keeps_all) {
        co_return co_await solve_with_cubic(desk, cell, solver, budget, EngineSettings{}.largest_displacement,
                                            measures, attractors);
    }

    scene::Oscillator<double> linear = cell.oscillator;
    linear.cubic = 0;
    CellResult without = co_await find_steady_state(desk, linear, cell.start, budget, {}, measures, attractors);
    if (is_linear || change_without_cubic(cell.oscillator, without) <= solver.omit_tolerance) {
        co_return without;
    }
    const double largest_displacement = std::isfinite(without.largest_displacement)
                                            ? without.largest_displacement
                                            : EngineSettings{}.largest_displacement;
    if (without.regime == Regime::periodic) {
        const CubicShift shift = co_await shift_by_cubic(
            desk, cell.oscillator, engine_with_cubic(cell.oscillator, solver, largest_displacement), without);
        without.cycles = sum_of_cycles(without.cycles, shift.cycles);
        if (shift.of_peak_force && *shift.of_peak_force <= solver.omit_tolerance) co_return without;
    }
    CellResult with =
        co_await solve_with_cubic(desk, cell, solver, budget, largest_displacement, measures, attractors);
    with.cycles = sum_of_cycles(with.cycles, without.cycles);
    co_return with;
}

CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    CycleDesk desk;
    return complete(solve_cell(desk, scene, row, column), desk);
}

}  // namespace peterka::regime
