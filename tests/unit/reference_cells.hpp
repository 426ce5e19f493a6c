// The steady states of tests/data/cells.csv, from an independent program in extended precision.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "rig.hpp"

namespace peterka::testing {

struct ReferenceCell {
    std::string name;
    scene::Oscillator<double> oscillator;
    scene::State<double> start;
    scene::State<double> end;  // on the orbit, at forcing phase 0; NaN where it isn't told
    double force_ratio_per_unit = 1;
    int impacts = 0;
    int period = 0;
    double peak_force_ratio = 0;
};

inline double number(const std::string& text) {
    return text.empty() ? std::nan("") : std::stod(text);
}

inline ReferenceCell parse_cell(const std::string& line) {
    std::vector<std::string> column;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) column.push_back(cell);
    column.resize(16);  // the last ones may be empty
    const double mass = number(column.at(1));
    const double stiffness = number(column.at(2));
    const double amplitude = number(column.at(4));
    const double omega = std::sqrt(stiffness / mass);
    ReferenceCell cell;
    cell.name = column.at(0) + ", frequency_ratio " + column.at(7) + ", gap " + column.at(8) + " m";
    cell.oscillator = {.damping_ratio = number(column.at(3)) / (2 * mass * omega),
                       .contact = scene::KelvinVoigt<double>{number(column.at(5)) / stiffness,
                                                             number(column.at(6)) / (mass * omega)},
                       .frequency = number(column.at(7)),
                       .gap = number(column.at(8)) / amplitude};
    cell.start = start_at(cell.oscillator, number(column.at(9)) / amplitude,
                          number(column.at(10)) / (amplitude * omega));
    cell.force_ratio_per_unit = stiffness * amplitude / (mass * 9.80665);
    cell.impacts = static_cast<int>(number(column.at(11)));
    cell.period = static_cast<int>(number(column.at(12)));
    cell.peak_force_ratio = number(column.at(13));
    cell.end = {number(column.at(14)) - cell.oscillator.gap, number(column.at(15))};
    return cell;
}

inline std::vector<ReferenceCell> read_cells() {
    std::ifstream file(PETERKA_SOURCE_DIR "/tests/data/cells.csv");
    std::vector<ReferenceCell> cells;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with('#') && !line.starts_with("case,")) cells.push_back(parse_cell(line));
    }
    return cells;
}

}  // namespace peterka::testing
