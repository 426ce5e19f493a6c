// One cycle of a map together with what a recorder saw of it.
#pragma once

#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::testing {

template <class Real>
struct Observed : trajectory::Cycle<Real> {
    Real peak_force = 0;
    Real largest_displacement = 0;  // the bound
};

template <class Map, class Real>
Observed<Real> observed(Map&& map, const Eigen::Matrix<Real, 2, 1>& x) {
    trajectory::Recorder<Real> recorder;
    const auto cycle = map(x, &recorder);
    return {cycle, recorder.totals().peak_force(), recorder.totals().displacement_bound};
}

}  // namespace peterka::testing
