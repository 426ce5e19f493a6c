#include "attractors/drawn_cells.hpp"

#include <cstddef>

#include "attractors/start_sequence.hpp"

namespace peterka::attractors {

namespace {

// In SI units, which drawn rigs share with the cell.
job::Starts in_si(job::Starts starts, const scene::Scales& scales) {
    const Interval across = displacements_of(starts, scales);
    const Interval up = velocities_of(starts, scales);
    const double speed = scales.length_m * scales.frequency_rad_per_s;
    starts.displacement_m = {across.from * scales.length_m, across.to * scales.length_m};
    starts.velocity_m_per_s = {up.from * speed, up.to * speed};
    return starts;
}

}  // namespace

DrawnCells::DrawnCells(const scene::UncertainCells& uncertain, const job::Job& job, std::int64_t row,
                       std::int64_t column, const scene::Scales& own)
    : uncertain_(uncertain), own_(job::numbers_at(job, row, column)), starts_(in_si(job.starts, own)) {}

scene::Cell DrawnCells::cell(std::int64_t n) const {
    scene::Cell drawn = uncertain_.cell(own_, static_cast<std::size_t>(n));
    if (starts_.count > 0) drawn.start = start_of(starts_, drawn, n);
    return drawn;
}

}  // namespace peterka::attractors
