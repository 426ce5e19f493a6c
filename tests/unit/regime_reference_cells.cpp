// Every row of tests/data/cells.csv: steady states from an independent program in extended precision.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "rig.hpp"

namespace peterka::regime {
namespace {

struct ReferenceCell {
    std::string name;
    scene::Oscillator<double> scene;
    scene::State<double> start;
    double force_ratio_per_unit = 1;
    int impacts = 0;
    int period = 0;
    double peak_force_ratio = 0;
};

double number(const std::string& text) {
    return text.empty() ? std::nan("") : std::stod(text);
}

ReferenceCell parse(const std::string& line) {
    std::vector<std::string> column;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) column.push_back(cell);
    const double mass = number(column.at(1));
    const double stiffness = number(column.at(2));
    const double amplitude = number(column.at(4));
    const double omega = std::sqrt(stiffness / mass);
    ReferenceCell cell;
    cell.name = column.at(0) + ", frequency_ratio " + column.at(7) + ", gap " + column.at(8) + " m";
    cell.scene = {.damping_ratio = number(column.at(3)) / (2 * mass * omega),
                  .contact = scene::KelvinVoigt<double>{number(column.at(5)) / stiffness,
                                                        number(column.at(6)) / (mass * omega)},
                  .frequency = number(column.at(7)),
                  .gap = number(column.at(8)) / amplitude};
    cell.start = testing::start_at(cell.scene, number(column.at(9)) / amplitude,
                                   number(column.at(10)) / (amplitude * omega));
    cell.force_ratio_per_unit = stiffness * amplitude / (mass * 9.80665);
    cell.impacts = static_cast<int>(number(column.at(11)));
    cell.period = static_cast<int>(number(column.at(12)));
    cell.peak_force_ratio = number(column.at(13));
    return cell;
}

std::vector<ReferenceCell> read_cells() {
    std::ifstream file(PETERKA_SOURCE_DIR "/tests/data/cells.csv");
    std::vector<ReferenceCell> cells;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with('#') && !line.starts_with("case,")) cells.push_back(parse(line));
    }
    return cells;
}

TEST(ReferenceCells, AreReproduced) {
    const auto cells = read_cells();
    ASSERT_EQ(cells.size(), 66U);
    for (const ReferenceCell& cell : cells) {
        SCOPED_TRACE(cell.name);
        const CellResult result = find_steady_state(cell.scene, cell.start, {});
        EXPECT_EQ(result.impacts, cell.impacts);
        EXPECT_EQ(result.period, cell.period);
        EXPECT_EQ(result.status, Status::proved);
        EXPECT_NEAR(result.peak_force * cell.force_ratio_per_unit, cell.peak_force_ratio,
                    1e-10 * cell.peak_force_ratio);
    }
}

}  // namespace
}  // namespace peterka::regime
