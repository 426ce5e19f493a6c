// Cells of the paper's rig with linear springs and any stop, as they are solved, for tests of what is proved of
// them.
#pragma once

#include <string>
#include <vector>

#include "certificate/certify.hpp"
#include "rig.hpp"
#include "scene/scales.hpp"

namespace peterka::testing {

struct SolvedPlace {
    job::CellNumbers numbers;
    regime::CellResult cell;
};

struct Stop {
    std::string name;
    job::Contact law;
};
inline const std::vector<Stop> stops{{"KelvinVoigt", job_170mm(0).contact},
                                     {"Rigid0", job::Restitution{0}},
                                     {"Rigid032", job::Restitution{0.32}},
                                     {"Rigid08", job::Restitution{0.8}}};

inline certificate::Claim claim_of(const regime::CellResult& cell) {
    return {cell.regime, {cell.impacts, cell.period, cell.orbit_displacement, cell.orbit_velocity}};
}

inline job::CellNumbers numbers_170mm(double frequency_ratio, double gap_ratio) {
    job::CellNumbers numbers = job::numbers_in(job_170mm(0));
    numbers.place = {.frequency_ratio = frequency_ratio, .gap_ratio = gap_ratio};
    return numbers;
}

inline scene::Oscillator<double> oscillator_at(const job::CellNumbers& numbers) {
    scene::Oscillator<double> oscillator = scene::oscillator_of(numbers);
    oscillator.frequency = numbers.frequency_ratio();
    oscillator.gap = numbers.gap_ratio();
    return oscillator;
}

inline SolvedPlace solved(const job::CellNumbers& numbers, double displacement = 0, double velocity = 0) {
    const scene::Oscillator<double> oscillator = oscillator_at(numbers);
    return {numbers, regime::find_steady_state(oscillator, start_at(oscillator, displacement, velocity), {}, {},
                                               {.detail = trajectory::Detail::contacts})};
}

inline SolvedPlace solved_at(double frequency_ratio, double gap_ratio) {
    return solved(numbers_170mm(frequency_ratio, gap_ratio));
}

// Cells of one regime on a grid over the paper's plane that misses round numbers.
inline std::vector<SolvedPlace> cells_of(regime::Regime regime, int points,
                                         const job::Contact& stop = job_170mm(0).contact) {
    std::vector<SolvedPlace> cells;
    for (int row = 0; row < points; ++row) {
        for (int column = 0; column < points; ++column) {
            job::CellNumbers numbers =
                numbers_170mm(0.503 + 3.9 * column / points, 0.0137 + 4.9 * row / points);
            numbers.contact = stop;
            SolvedPlace place = solved(numbers);
            if (place.cell.regime == regime) cells.push_back(place);
        }
    }
    return cells;
}

}  // namespace peterka::testing
