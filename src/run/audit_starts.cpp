#include "run/audit_starts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "attractors/multi_start_pool.hpp"
#include "attractors/start_sequence.hpp"
#include "regime/same_attractor.hpp"
#include "regime/solve_cell.hpp"
#include "run/audit_sample.hpp"

namespace peterka {
namespace {

// An integrator takes a thousand times as long as the map does, so a cell has few of its starts audited.
constexpr std::int64_t most_starts = 8;

// The end of every start, as the map found it.
std::vector<regime::CellResult> ends_of_starts(const scene::Scene& scene, std::int64_t row,
                                               std::int64_t column) {
    std::vector<regime::CellResult> ends;
    const regime::AttractorTable none;
    attractors::MultiStartPool pool(
        scene, none,
        [&](attractors::MultiStartPool::NumberedCell solved) { ends = std::move(solved.cell.ends); },
        attractors::Ends::told);
    pool.add(row, column, 0);
    while (!pool.empty()) pool.step();
    return ends;
}

}  // namespace

map_file::AuditedStarts audit_starts(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    map_file::AuditedStarts audited;
    const job::Job& job = scene.job();
    if (job.starts.count == 0) return audited;
    const std::vector<regime::CellResult> ends = ends_of_starts(scene, row, column);
    scene::Cell cell = scene.cell(row, column);
    audited.solved = static_cast<std::int32_t>(std::min(job.starts.count, most_starts));
    constexpr std::int64_t draws = 1 << 15;
    const std::int64_t draw = (row * scene.columns() + column) % draws;
    for (std::int64_t i = 0; i < audited.solved; ++i) {
        const std::int64_t n = audited_cell(i, audited.solved, job.starts.count, draw);
        const regime::CellResult& end = ends[static_cast<std::size_t>(n)];
        cell.start = attractors::start_of(job.starts, cell, n);
        const regime::CellResult again = regime::solve_again(job, cell, end.engine);
        if (regime::same_attractor(end, again)) continue;
        ++audited.elsewhere;
        const double sensitivity = std::fmax(end.sensitivity, again.sensitivity);
        audited.decided_by_rounding += sensitivity > regime::rounding_decides ? 1 : 0;
    }
    return audited;
}

}  // namespace peterka
