// The cells that a cell becomes with each rig drawn for it: from [start] or, with [starts], each from a start
// of its own, in the same rectangle in SI units.
#pragma once

#include <cstdint>

#include "job/cell_numbers.hpp"
#include "job/job.hpp"
#include "scene/scene.hpp"
#include "scene/uncertain_cells.hpp"

namespace peterka::attractors {

class DrawnCells {
  public:
    // own: the cell without uncertainty, of a map or of a sweep's row. `uncertain` must outlive this.
    DrawnCells(const scene::UncertainCells& uncertain, const job::Job& job, std::int64_t row,
               std::int64_t column, const scene::Scales& own);

    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(uncertain_.count()); }
    [[nodiscard]] scene::Cell cell(std::int64_t n) const;

  private:
    const scene::UncertainCells& uncertain_;
    job::CellNumbers own_;
    job::Starts starts_;
};

}  // namespace peterka::attractors
