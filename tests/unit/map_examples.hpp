// Small maps, made-up cells and a folder to write into, for the tests of files on one rank and on several.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "job/job.hpp"
#include "map_file/arithmetic.hpp"
#include "map_file/provenance.hpp"
#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"
#include "regime/cell_result.hpp"

namespace peterka::map_file::examples {

// A folder that exists as long as this object.
class Folder {
  public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "peterka-output-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path_ = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            all.push_back(entry.path().filename().string());
        }
        return all;
    }

  private:
    std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_content(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

inline job::Job small_map(std::int64_t rows, std::int64_t columns) {
    job::Job job;
    job.title = "A small map";
    job.hammer.mass_kg = 0.298;
    job.hammer.natural_frequency_hz = 4.5;
    job.hammer.damping_ns_per_m = 0.06;
    job.cart.amplitude_m = 0.89e-3;
    job.contact = job::KelvinVoigt{5.5e6, 1.2e3};
    job.columns = {0.5, 4.5, columns};
    job.rows = {0.0, 5.0, rows};
    return job;
}

inline job::Job small_basin(std::int64_t rows, std::int64_t columns) {
    job::Job job = small_map(rows, columns);
    job.kind = job::Kind::basin;
    job.operating_point = {1.8, 1.6};
    return job;
}

inline Provenance made_by() {
    return {"1.2.3", "abcdef", "1.10", "MPI 4", sundials_version(), "3.4", "9.1", arithmetic()};
}

// Six kinds of cells, of which the periodic ones lie on one of `orbits` orbits.
inline regime::CellResult made_up_cell(std::int64_t row, std::int64_t column, int orbits = 3) {
    regime::CellResult cell;
    const std::int64_t number = row * 31 + column * 17;
    cell.regime = static_cast<regime::Regime>(number % 6);
    cell.cycles = static_cast<std::int32_t>(row + 2 * column);
    // Largest somewhere in the middle.
    cell.peak_force = 0.25 * static_cast<double>(row * 13 % 50) + 0.5 * static_cast<double>(column * 29 % 70);
    cell.impact_rate = 0.5;
    if (cell.regime == regime::Regime::periodic) {
        const auto orbit = static_cast<int>(number / 6 % orbits);
        cell.impacts = 1 + orbit % 2;
        cell.period = 1;
        cell.orbit_displacement = 0.125 * orbit;
        cell.orbit_velocity = -1.0;
    }
    if (cell.regime == regime::Regime::unresolved) cell.status = regime::Status::budget;
    if (cell.regime == regime::Regime::failed) {
        cell.status = regime::Status::not_finite;
        cell.peak_force = regime::unknown;
    }
    return cell;
}

inline std::vector<regime::CellResult> made_up_cells(const parallel::Tile& tile, int orbits = 3) {
    std::vector<regime::CellResult> cells;
    for (std::int64_t row = 0; row < tile.extent.rows; ++row) {
        for (std::int64_t column = 0; column < tile.extent.columns; ++column) {
            cells.push_back(made_up_cell(tile.row + row, tile.column + column, orbits));
        }
    }
    return cells;
}

// The same as a map is given them.
inline std::vector<attractors::SolvedCell> solved(const std::vector<regime::CellResult>& cells) {
    std::vector<attractors::SolvedCell> solved;
    for (const regime::CellResult& cell : cells) solved.push_back({cell, {}});
    return solved;
}

// The same as files hold them, where every unit is 1.
inline std::vector<quantities::StoredCell> made_up_stored_cells(const parallel::Tile& tile, int orbits = 3) {
    std::vector<quantities::StoredCell> cells;
    for (const auto& cell : made_up_cells(tile, orbits)) cells.push_back(quantities::in_file_units(cell, {}));
    return cells;
}

}  // namespace peterka::map_file::examples
