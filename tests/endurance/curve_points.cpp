// Whether points of curves are orbits of the hammer: each is followed through its q forcing cycles by the
// engine of maps, which finds the events of the motion by itself and shares nothing with the equations that
// curves solve for events that are assumed.
//
// Reads lines "damping_ratio rigid A B frequency_ratio gap_ratio q displacement velocity": A, B are the stop's
// kappa and chi or, if rigid is 1, its coefficient of restitution and 0; displacement [A0] and velocity [A0
// omega] are at forcing phase 0. Writes for each by how far the motion misses its beginning, in the same units.
#include <fmt/format.h>

#include <iostream>
#include <limits>

#include "scene/oscillator.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace {

using namespace peterka;
using Done = trajectory::Cycle<double>::Outcome;

template <class Map>
double missed_by(const Map& map, const scene::State<double>& begin, int cycles) {
    scene::State<double> state = begin;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const auto one = map(state);
        if (one.outcome != Done::done) return std::numeric_limits<double>::infinity();
        state = one.end;
    }
    return (state - begin).norm();
}

}  // namespace

int main() {
    scene::Oscillator<double> oscillator;
    int rigid = 0;
    int cycles = 0;
    double a = 0;
    double b = 0;
    scene::State<double> begin{0, 0};
    while (std::cin >> oscillator.damping_ratio >> rigid >> a >> b >> oscillator.frequency >> oscillator.gap >>
           cycles >> begin[0] >> begin[1]) {
        begin[0] -= oscillator.gap;
        double missed = 0;
        if (rigid != 0) {
            oscillator.contact = scene::Restitution<double>{a};
            missed = missed_by(trajectory::RigidExactMap<double>(oscillator), begin, cycles);
        } else {
            oscillator.contact = scene::KelvinVoigt<double>{a, b};
            missed = missed_by(trajectory::ExactCycleMap<double>(oscillator), begin, cycles);
        }
        fmt::print("{}\n", missed);
    }
    return 0;
}
