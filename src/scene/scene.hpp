// Everything that solving the cells of a job needs, in nondimensional form.
#pragma once

#include <cstdint>

#include "job/job.hpp"
#include "scene/oscillator.hpp"
#include "scene/scales.hpp"

namespace peterka::scene {

// One cell: its oscillator, and where the hammer starts relative to the stop at forcing phase 0.
struct Cell {
    Oscillator<double> oscillator;
    State<double> start;
};

class Scene {
  public:
    explicit Scene(const job::Job& job);

    [[nodiscard]] const job::Job& job() const { return job_; }
    [[nodiscard]] const Scales& scales() const { return scales_; }
    [[nodiscard]] std::int64_t rows() const { return job_.row_count(); }
    [[nodiscard]] std::int64_t columns() const { return job_.columns.points; }
    // Of a sweep the row is a branch, and the start that of its first point; a trace has one cell, whatever its
    // place.
    [[nodiscard]] Cell cell(std::int64_t row, std::int64_t column) const;

  private:
    [[nodiscard]] Cell cell_at(const job::OperatingPoint& place, const job::Start& start) const;

    job::Job job_;
    Scales scales_;
    Oscillator<double> oscillator_;
};

}  // namespace peterka::scene
