// The contribution of a cubic spring to the linear equations of all legs (see trajectory/split_cycle_map.hpp).
#pragma once

#include "motion/linear_motion.hpp"
#include "scene/oscillator.hpp"

namespace peterka::trajectory {

template <class Real>
struct SpringChange {
    Real stiffness = 0;
    Real offset = 0;
    Real drive = 0;

    [[nodiscard]] motion::LinearEquation<Real> operator()(motion::LinearEquation<Real> equation) const {
        equation.stiffness += stiffness;
        equation.offset += offset;
        equation.drive += drive;
        return equation;
    }
};

// y, y2: means of the cart's position and of its square in the absolute form; 0 in the relative one.
template <class Real>
SpringChange<Real> cubic_about_stop(const scene::Oscillator<Real>& oscillator, Real y = 0, Real y2 = 0) {
    const Real gap = oscillator.gap;
    const bool absolute = oscillator.cubic_form == job::CubicForm::absolute;
    return {.stiffness = 3 * oscillator.cubic * (gap * gap + 2 * gap * y + y2),
            .offset = -oscillator.cubic * gap * (gap * gap + 3 * y2),
            .drive = absolute ? -3 * oscillator.cubic * gap * gap : Real(0)};
}

}  // namespace peterka::trajectory
