// Everything needed to solve the cells of a job, in nondimensional form.
#pragma once

#include <cstdint>

#include "job/job.hpp"
#include "scene/oscillator.hpp"
#include "scene/scales.hpp"

namespace peterka::scene {

// One cell: its oscillator, where the hammer starts relative to the stop at forcing phase 0, and its units.
struct Cell {
    Oscillator<double> oscillator;
    State<double> start;
    Scales scales = {};
};

// Whether two oscillators have the same springs, dampers and stop; frequency and gap may differ.
[[nodiscard]] bool same_rig(const Oscillator<double>& a, const Oscillator<double>& b);

class Scene {
  public:
    explicit Scene(const job::Job& job);

    [[nodiscard]] const job::Job& job() const { return job_; }
    // From the job's tables; a cell of a map over parameters of the rig has its own.
    [[nodiscard]] const Scales& scales() const { return scales_; }
    // Whether springs, dampers or stop differ between cells.
    [[nodiscard]] bool rigs_differ() const { return rigs_differ_; }
    [[nodiscard]] std::int64_t rows() const { return job_.row_count(); }
    [[nodiscard]] std::int64_t columns() const { return job_.columns.points; }
    // In a sweep the row is a branch, and the start is that of its first point; a trace has one cell, whatever
    // row and column.
    [[nodiscard]] Cell cell(std::int64_t row, std::int64_t column) const;

  private:
    job::Job job_;
    Scales scales_;
    Oscillator<double> oscillator_;
    bool varies_;  // an axis runs over a parameter of the rig
    bool rigs_differ_;
};

}  // namespace peterka::scene
