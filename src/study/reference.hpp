// The motion in extended precision (about 1e-18), with which engines are compared: in closed form where there
// is one, by Taylor series otherwise. Where both exist they agree to 1e-16 (a test).
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "regime/steady_state.hpp"
#include "study/taylor_cycle_map.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::study {

using Extended = long double;
using ReferenceCycle = trajectory::MeasuredCycle<Extended>;

class Reference {
  public:
    explicit Reference(const scene::Oscillator<double>& oscillator);

    [[nodiscard]] bool is_closed_form() const { return map_.index() == 0; }
    // One cycle from the state x at forcing phase 0.
    [[nodiscard]] ReferenceCycle operator()(const scene::State<Extended>& x) const;

  private:
    std::variant<trajectory::ExactCycleMap<Extended>, study::TaylorCycleMap> map_;
};

// A stable periodic orbit with impacts: its point at the start of each of its cycles, and the cycles.
struct ReferenceOrbit {
    std::vector<scene::State<Extended>> points;
    std::vector<ReferenceCycle> cycles;

    [[nodiscard]] std::size_t period() const { return cycles.size(); }
    [[nodiscard]] std::int64_t impacts() const;
    [[nodiscard]] Extended peak_force() const;
    [[nodiscard]] Extended largest_displacement() const;
};

// The orbit to which this start leads, refined in extended precision; nothing if it leads to none.
[[nodiscard]] std::optional<ReferenceOrbit> reference_orbit(const scene::Oscillator<double>& oscillator,
                                                            const scene::State<double>& start,
                                                            const job::SteadyState& budget);

}  // namespace peterka::study
