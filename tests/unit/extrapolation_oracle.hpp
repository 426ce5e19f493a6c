// The hammer against any compliant stop, by Gragg's extrapolated midpoint rule in long double: an independent
// reference for the integrators.
//
// Written from the model alone: u'' = eta^2 sin(theta) - 2 zeta u' - u - r - f. Steps follow an error estimate
// of 1e-16, so they shrink by themselves where Hunt and Crossley's force is not smooth; events are bracketed by
// the signs at a step's ends and bisected by shorter steps from the same start.
#pragma once

#include <array>

#include "scene/oscillator.hpp"

namespace peterka::testing {

class ExtrapolationOracle {
  public:
    using Real = long double;

    // start: (delta, delta') at forcing phase 0.
    ExtrapolationOracle(const scene::Oscillator<double>& oscillator, const scene::State<double>& start);

    // Carries on for so many forcing cycles.
    void advance(int cycles);

    [[nodiscard]] scene::State<double> state() const { return {double(y_[0]), double(y_[1])}; }
    // Of the last advance:
    [[nodiscard]] int impacts() const { return impacts_; }
    [[nodiscard]] double peak_force() const { return double(peak_force_); }
    [[nodiscard]] double impact_speed() const { return double(impact_speed_); }   // the largest
    [[nodiscard]] double contact_work() const { return double(y_[3]); }           // integral of f delta'
    [[nodiscard]] double drive_work() const { return double(y_[4]); }             // of eta^2 sin(theta) delta'
    [[nodiscard]] double damper_loss() const { return double(y_[5]); }            // of 2 zeta delta'^2
    [[nodiscard]] double largest_displacement() const { return double(reach_); }  // of |u|
    [[nodiscard]] double contact_time() const {
        return double(contact_time_);
    }                                                                          // of the longest contact, in all
    [[nodiscard]] double largest_impulse() const { return double(impulse_); }  // of its contacts
    [[nodiscard]] double total_impulse() const { return double(total_impulse_); }  // integral of f

  private:
    enum class Phase { flight, contact, unloaded };
    using Unknowns = std::array<Real, 6>;  // delta, delta', and the integrals of f, f delta', drive and damper
    struct Trial {
        Unknowns y;
        Real error;
    };

    [[nodiscard]] Real force(const Unknowns& y) const;
    [[nodiscard]] Real hold(const Unknowns& y) const;  // positive while the stop presses
    [[nodiscard]] Unknowns slope(Real time, const Unknowns& y) const;
    [[nodiscard]] Trial trial(Real step) const;
    [[nodiscard]] Real over(const Unknowns& y) const;  // positive once the phase is over
    void look_for_extrema(Real step);
    void finish_phase();
    void close_impact();

    scene::Oscillator<double> oscillator_;
    Unknowns y_{};
    Real time_ = 0;  // since the cycle began
    Phase phase_ = Phase::flight;
    int impacts_ = 0;
    Real peak_force_ = 0, impact_speed_ = 0, reach_ = 0;
    Real impulse_ = 0, total_impulse_ = 0, open_time_ = 0, contact_time_ = 0;
};

}  // namespace peterka::testing
