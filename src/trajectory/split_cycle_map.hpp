// The stroboscopic map with a weak cubic spring: exact linear legs, and kicks by the remainder of the cubic
// force.
//
// With u = gap + delta, and y the cart's position in the absolute form but 0 in the relative one, that force is
//     cubic ((u + y)^3 - y^3) = cubic gap (gap^2 + 3 gap y + 3 y^2)
//                             + 3 cubic (gap + y)^2 delta
//                             + cubic delta^2 (3 (gap + y) + delta).
// The first two lines belong to the linear equations: y^2 and the y of the second line by their means over each
// step, and the y of the first exactly, as a part of the drive. The third is the kick: half a kick, linear legs
// over a step h, half a kick (Strang splitting, Strang 1968, second order in h).
// Kicks of the whole cubic force would make the velocity within a step wrong by up to h/2 times the force, and
// every impact there wrong to first order. These kicks vanish at the stop, and with them the error at an
// impact: the peak force of a weak relative cubic is wrong by h^3, terms quadratic in the cubic by h^2.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "motion/linear_motion.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/linear_legs.hpp"
#include "trajectory/rigid_legs.hpp"
#include "trajectory/spring_change.hpp"

namespace peterka::trajectory {

template <class Real, class Legs = LinearLegs<Real>>
class SplitCycleMap {
  public:
    SplitCycleMap(const Oscillator<Real>& oscillator, int steps_per_cycle)
        : oscillator_(oscillator),
          steps_(steps_per_cycle),
          changes_(oscillator.cubic != 0 && oscillator.cubic_form == job::CubicForm::absolute &&
                   oscillator.frequency > 0) {
        for (int step = 0; step <= steps_; ++step) cart_.push_back(changes_ ? std::sin(phase(step)) : Real(0));
        for (int step = 0; step < (changes_ ? steps_ : 1); ++step) legs_.push_back(legs_of(step));
    }

    [[nodiscard]] const Oscillator<Real>& oscillator() const { return oscillator_; }
    [[nodiscard]] int steps_per_cycle() const { return steps_; }

    // One cycle from the state x at forcing phase 0; a recorder collects the events on the way. The outcome
    // without any steps is solver_failed.
    [[nodiscard]] Cycle<Real> operator()(const State<Real>& x, Recorder<Real>* recorder = nullptr) const {
        if (steps_ < 1) return {.outcome = Cycle<Real>::Outcome::solver_failed, .end = x};
        const Real period = oscillator_.period();
        Journey<Real> journey = legs_.front().depart(x);
        for (int step = 0; step < steps_; ++step) {
            half_kick(cart_[static_cast<std::size_t>(step)], journey);
            show_motion(step, recorder);
            const Real end = step + 1 < steps_ ? period * Real(step + 1) / Real(steps_) : period;
            const Legs& legs = legs_[changes_ ? static_cast<std::size_t>(step) : 0];
            if (!legs.run(journey, end, recorder)) return journey.cycle;
            half_kick(cart_[static_cast<std::size_t>(step) + 1], journey);
        }
        legs_.back().arrive(journey, recorder);
        return journey.cycle;
    }

    // Part of a cycle: from the state x at tau = from to a later tau = to. Its first and last steps may be
    // shorter than the others.
    [[nodiscard]] Cycle<Real> part(const State<Real>& x, Real from, Real to) const {
        if (steps_ < 1) return {.outcome = Cycle<Real>::Outcome::solver_failed, .end = x};
        const Real length = oscillator_.period() / Real(steps_);
        Journey<Real> journey = legs_.front().depart(x, from);
        for (int step = std::min(static_cast<int>(from / length), steps_ - 1); journey.time < to; ++step) {
            const Real begin = journey.time;
            const Real end = step + 1 < steps_ ? std::min(to, length * Real(step + 1)) : to;
            const Real share = (end - begin) / length;
            half_kick(cart_at(begin), journey, share);
            const Legs& legs = legs_[changes_ ? static_cast<std::size_t>(step) : 0];
            if (!legs.run(journey, end, nullptr)) return journey.cycle;
            half_kick(cart_at(end), journey, share);
        }
        legs_.back().arrive(journey, nullptr);
        return journey.cycle;
    }

  private:
    // Forcing phase at which a step begins.
    [[nodiscard]] Real phase(int step) const {
        return 2 * std::numbers::pi_v<Real> * Real(step) / Real(steps_);
    }

    // The cart's position where the equations depend on it, else 0.
    [[nodiscard]] Real cart_at(Real tau) const {
        return changes_ ? std::sin(oscillator_.frequency * tau) : Real(0);
    }

    [[nodiscard]] Legs legs_of(int step) const {
        // means over the step of y and y^2
        const Real length = phase(1);
        const Real middle = phase(step) + length / 2;
        const Real y = changes_ ? std::sin(middle) * std::sin(length / 2) / (length / 2) : Real(0);
        const Real y2 = changes_ ? (1 - std::cos(2 * middle) * std::sin(length) / length) / 2 : Real(0);
        return Legs(oscillator_, cubic_about_stop(oscillator_, y, y2));
    }

    // The velocity that a half kick removes.
    [[nodiscard]] Real half_kick(Real y, Real delta) const {
        const Real impulse = oscillator_.cubic * oscillator_.period() / Real(2 * steps_);
        return impulse * delta * delta * (3 * (oscillator_.gap + y) + delta);
    }

    // Within a step the velocity is that of the motion only at its middle: before it, a part of the half kick
    // already applied came too early, and after it, a part of the next one is missing. This is corrected for an
    // observer; the remaining error is quadratic in the step.
    void show_motion(int step, Recorder<Real>* recorder) const {
        if (recorder == nullptr || recorder->observer() == nullptr) return;
        const Real length = oscillator_.period() / Real(steps_);
        recorder->show([this, step, length](Real tau, const State<Real>& x) {
            const Real passed = tau / length - Real(step);  // 0 to 1
            return State<Real>(x[0], x[1] + half_kick(cart_at(tau), x[0]) * (1 - 2 * passed));
        });
    }

    // share: of a whole step.
    void half_kick(Real y, Journey<Real>& journey, Real share = 1) const {
        Cycle<Real>& cycle = journey.cycle;
        const Real impulse = share * oscillator_.cubic * oscillator_.period() / Real(2 * steps_);
        const Real stretch = 3 * (oscillator_.gap + y);
        const Real delta = cycle.end[0];
        if (delta == 0) return;
        cycle.end[1] -= impulse * delta * delta * (stretch + delta);
        cycle.jacobian.row(1) -= impulse * delta * (2 * stretch + 3 * delta) * cycle.jacobian.row(0);
        if (journey.phase == Phase::flight) return;
        // a kick can make the force change its sign: a release, or the contact resumes
        const Phase phase = phase_of(oscillator_, cycle.end);
        if (phase == journey.phase) return;
        journey.phase = phase;
        if (phase != Phase::flight) cycle.pattern = append(cycle.pattern, pattern_of(phase));
    }

    Oscillator<Real> oscillator_;
    int steps_;
    bool changes_;            // the linear equations change with the cart's position
    std::vector<Real> cart_;  // y where the steps begin, and at the end of the last
    std::vector<Legs> legs_;  // one for all steps, or one each where the equations change
};

template <class Real>
using RigidSplitMap = SplitCycleMap<Real, RigidLegs<Real>>;

// Steps per cycle that keep the relative error of the peak force of a regular orbit below a tolerance, for |u|
// up to largest_displacement; 1 without a cubic term. 0 if splitting is unsuitable: more than most_split_steps,
// at which an integrator is no more expensive, or a softening spring that may give way.
//
// With E the cubic's largest share in the springs' stiffness, and E_g the same with one factor u at the stop,
// the errors measured on the paper's rig with 1 to 1e5 times its cubic (E up to 40) stay below 0.02 E_g h^3 +
// 0.007 E h^4 + 0.16 min(E, E^2) h^2. The absolute form adds up to 0.15 E (h max(1, eta))^2, and a stop so soft
// that kicks fall into the contact E/kappa h^2. The rule takes about four times that, and a third of the
// tolerance for each power. Close to a bifurcation any error grows.
//
// Few different numbers, so that many cells share one and can be advanced together.
inline constexpr int fewest_split_steps = 10;
inline constexpr int most_split_steps = 512;

// Rounded up to the fewest or a multiple of 16, and above 64 to a power of two or three quarters of one.
inline int rounded_split_steps(int steps) {
    if (steps <= fewest_split_steps) return fewest_split_steps;
    const auto size = std::bit_ceil(static_cast<unsigned>(steps));
    const int unit = std::max(16, static_cast<int>(size / 4));
    return (steps + unit - 1) / unit * unit;
}

inline int split_steps(const Oscillator<double>& oscillator, double largest_displacement, double tolerance) {
    if (oscillator.cubic == 0) return 1;
    const bool absolute = oscillator.cubic_form == job::CubicForm::absolute;
    const double cart = absolute ? oscillator.cart_reach() : 0;
    const double reach = largest_displacement + cart;
    const double share = 3 * std::abs(oscillator.cubic) * reach * reach;
    const double share_at_stop = 3 * std::abs(oscillator.cubic) * reach * (std::abs(oscillator.gap) + cart);
    if (oscillator.cubic < 0 && share > 0.5) return 0;
    const double fast = std::max(1.0, oscillator.frequency);
    const auto* voigt = oscillator.spring_dashpot();  // a rigid stop isn't soft
    const double second = 0.7 * std::min(share, share * share) + 0.6 * cart * share * fast * fast +
                          (voigt == nullptr ? 0.0 : 3 * share / (1 + voigt->stiffness));
    const double third = 0.1 * share_at_stop;
    const double fourth = 0.03 * share;
    const double part = tolerance / 3;
    // the linear motion between two kicks turns by pi/4 at most
    const double stiffest = std::sqrt(1 + 3 * std::abs(oscillator.cubic) * oscillator.gap * oscillator.gap);
    const double step = std::min({std::sqrt(part / second), std::cbrt(part / third),
                                  std::sqrt(std::sqrt(part / fourth)), 0.785 / std::max(fast, stiffest)});
    const double steps = std::ceil(oscillator.period() / step);
    return steps <= most_split_steps ? rounded_split_steps(static_cast<int>(steps)) : 0;
}

}  // namespace peterka::trajectory
