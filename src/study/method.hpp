// Ways to carry a trajectory through a forcing cycle, as compared in studies: the engines of this program, and
// common practice.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "integrators/integrated_cycle_map.hpp"
#include "study/rk4_cycle_map.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::study {

using scene::Oscillator;
using scene::State;

// Stored as int8; the numbers are part of the file format.
enum class Method : std::int8_t {
    exact = 0,
    split = 1,
    cvode_adams = 2,
    cvode_bdf = 3,
    arkode_explicit = 4,
    arkode_implicit = 5,
    rk4_with_events = 6,
    rk4_without_events = 7,
    batched = 8,
};
inline constexpr std::array<const char*, 9> method_names{
    "exact",           "split",           "cvode_adams",        "cvode_bdf", "arkode_explicit",
    "arkode_implicit", "rk4_with_events", "rk4_without_events", "batched"};

// The setting is the requested relative error of the peak force, or the steps per cycle of a fixed step; 0 if
// there is none.
struct Run {
    Method method = Method::exact;
    double setting = 0;
};

// Every method at each of its settings, one method after another. The batched engine is included only without a
// cubic spring, split only with one; the error of exact is then that of omitting the spring.
[[nodiscard]] std::vector<Run> runs(bool cubic, std::span<const double> tolerances,
                                    std::span<const std::int64_t> steps_per_cycle);

// The quantities of one cycle that are compared.
struct Observation {
    bool ok = false;
    State<double> end = State<double>::Zero();
    std::int64_t impacts = 0;
    double peak_force = 0;  // F/(k A0)
    double last_touch = 0;  // tau since the cycle began, NaN without an impact
};

// A single cell by any method but the batched one, for which see batch_trial.hpp.
class MethodMap {
  public:
    // largest_displacement: of |u|, for which the kicks of `split` are chosen.
    MethodMap(const Oscillator<double>& oscillator, const Run& run, double largest_displacement);

    // One cycle: state, Jacobian and contacts, without measuring anything. False if it fails.
    [[nodiscard]] bool advance(State<double>& x);
    [[nodiscard]] Observation observe(const State<double>& x);

  private:
    std::variant<trajectory::ExactCycleMap<double>, trajectory::SplitCycleMap<double>,
                 integrators::IntegratedCycleMap, study::Rk4CycleMap>
        map_;
};

}  // namespace peterka::study
