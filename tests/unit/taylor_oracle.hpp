// The hammer with its cubic spring, by Taylor series in long double: an independent reference for engines.
//
// The equation of motion is a polynomial in u, sin(theta) and cos(theta), so it gives the coefficients of its
// own series one after another. Steps are short; events are bracketed by sign changes on a fine grid of each
// step and bisected on the series.
#pragma once

#include <array>

#include "scene/oscillator.hpp"

namespace peterka::testing {

class TaylorOracle {
  public:
    using Real = long double;

    // start: (delta, delta') at forcing phase 0.
    TaylorOracle(const scene::Oscillator<double>& scene, const scene::State<double>& start);

    // Carries on for so many forcing cycles.
    void advance(int cycles);

    [[nodiscard]] Real delta() const { return u_ - gap_; }
    [[nodiscard]] Real velocity() const { return v_; }
    [[nodiscard]] Real peak_force() const { return peak_force_; }  // of the last advance
    [[nodiscard]] int impacts() const { return impacts_; }         // in the last advance

  private:
    static constexpr int order = 22;
    enum class Phase { flight, contact, unloaded };
    struct Point {
        Real u, v;
    };

    void expand();
    [[nodiscard]] Point at(Real t) const;
    [[nodiscard]] Real force(const Point& p) const { return stiffness_ * (p.u - gap_) + damping_ * p.v; }
    // Positive once the phase is over.
    [[nodiscard]] Real over(const Point& p) const;
    void step(Real longest);
    void finish_phase();
    void raise_peak(Real from, Real to);

    Real zeta_, stiffness_, damping_, eta_, gap_, cubic_, cart_;
    Real u_, v_;
    Real time_ = 0;  // since the cycle began
    Phase phase_;
    std::array<Real, order + 1> series_{};
    Real peak_force_ = 0;
    int impacts_ = 0;
};

}  // namespace peterka::testing
