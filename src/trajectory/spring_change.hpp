// What a cubic spring adds to the linear equations of all legs.
#pragma once

#include "motion/linear_motion.hpp"

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

}  // namespace peterka::trajectory
