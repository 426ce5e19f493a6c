// The hammer by Taylor series in long double, as a motion that is carried on: a reference for engines.
#pragma once

#include <algorithm>

#include "scene/in_precision.hpp"
#include "study/taylor_cycle_map.hpp"

namespace peterka::testing {

class TaylorOracle {
  public:
    using Real = long double;

    // start: (delta, delta') at forcing phase 0.
    TaylorOracle(const scene::Oscillator<double>& oscillator, const scene::State<double>& start)
        : map_(scene::in_precision<Real>(oscillator)), x_(start.cast<Real>()) {}

    // Carries on for so many forcing cycles.
    void advance(int cycles) {
        peak_force_ = 0;
        impacts_ = 0;
        for (int n = 0; n < cycles; ++n) {
            const auto cycle = map_(x_);
            x_ = cycle.end;
            peak_force_ = std::max(peak_force_, cycle.peak_force);
            impacts_ += cycle.impacts;
        }
    }

    [[nodiscard]] Real delta() const { return x_[0]; }
    [[nodiscard]] Real velocity() const { return x_[1]; }
    [[nodiscard]] Real peak_force() const { return peak_force_; }  // of the last advance
    [[nodiscard]] int impacts() const { return impacts_; }         // in the last advance

  private:
    study::TaylorCycleMap map_;
    scene::State<Real> x_;
    Real peak_force_ = 0;
    int impacts_ = 0;
};

}  // namespace peterka::testing
