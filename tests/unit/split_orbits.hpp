// Rigs with a cubic spring, and the stable orbits on which they settle.
#pragma once

#include <algorithm>
#include <array>

#include "observed.hpp"
#include "rig.hpp"
#include "taylor_oracle.hpp"

namespace peterka::testing {

struct Place {
    double frequency;
    double gap;
};
// one stable orbit each, of period 1 or 2
inline constexpr std::array<Place, 8> regular_cells{
    {{2.0, 0.0}, {1.3, 1.0}, {1.1, 4.0}, {3.5, 0.3}, {2.75, 0.0}, {0.8, 0.2}, {3.1, 0.0}, {4.2, 0.5}}};

inline scene::Oscillator<double> cubic_rig(const Place& place, double cubic,
                                           job::CubicForm form = job::CubicForm::relative) {
    auto oscillator = paper_rig(beam_170mm, place.frequency, place.gap);
    oscillator.cubic = cubic;
    oscillator.cubic_form = form;
    return oscillator;
}

struct Orbit {
    scene::State<double> point;
    double peak_force = 0;
    double largest_displacement = 0;
    int impacts = 0;
};

// Where a start has settled; force and impacts over four cycles.
template <class Map>
Orbit settle(const Map& map, const scene::State<double>& start) {
    Orbit orbit{start};
    for (int n = 0; n < 1500; ++n) orbit.point = map(orbit.point).end;
    scene::State<double> x = orbit.point;
    for (int n = 0; n < 4; ++n) {
        const auto cycle = observed(map, x);
        x = cycle.end;
        orbit.impacts += cycle.impacts;
        orbit.peak_force = std::max(orbit.peak_force, cycle.peak_force);
        orbit.largest_displacement = std::max(orbit.largest_displacement, cycle.largest_displacement);
    }
    return orbit;
}

template <class Map>
Orbit settle(const Map& map) {
    return settle(map, start_at(map.oscillator()));
}

// The stable orbit near a point, by the oracle, over four cycles.
inline TaylorOracle settled_oracle(const scene::Oscillator<double>& oscillator,
                                   const scene::State<double>& near, int settling = 60) {
    TaylorOracle oracle(oscillator, near);
    oracle.advance(settling);
    oracle.advance(4);
    return oracle;
}

}  // namespace peterka::testing
