#include "run/audit_tries.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "attractors/drawn_cells.hpp"
#include "attractors/multi_start_pool.hpp"
#include "attractors/start_sequence.hpp"
#include "regime/same_attractor.hpp"
#include "regime/solve_cell.hpp"
#include "run/audit_sample.hpp"

namespace peterka {
namespace {

// An integrator takes a thousand times as long as the map does, so a cell has few of its starts or rigs
// audited.
constexpr std::int64_t most_tries = 8;

// With the end of every start and rig, as the map found it.
attractors::SolvedCell with_ends(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    attractors::SolvedCell told;
    const regime::AttractorTable none;
    attractors::MultiStartPool pool(
        scene, none, [&](attractors::MultiStartPool::NumberedCell& solved) { told = std::move(solved.cell); },
        attractors::Ends::told);
    pool.add(row, column, 0);
    while (!pool.empty()) pool.step();
    return told;
}

// draw: a number that differs from cell to cell. place: that of try n, as the map solved it. same: whether two
// ends are alike.
template <class Place, class Same>
map_file::AuditedTries audit(const std::vector<regime::CellResult>& ends, const job::Job& job,
                             std::int64_t draw, Place place, Same same) {
    map_file::AuditedTries audited;
    audited.solved = static_cast<std::int32_t>(std::min(std::ssize(ends), most_tries));
    for (std::int64_t i = 0; i < audited.solved; ++i) {
        const std::int64_t n = audited_cell(i, audited.solved, std::ssize(ends), draw);
        const regime::CellResult& end = ends[static_cast<std::size_t>(n)];
        const regime::CellResult again = regime::solve_again(job, place(n), end.engine);
        if (same(end, again)) continue;
        ++audited.elsewhere;
        const double sensitivity = std::fmax(end.sensitivity, again.sensitivity);
        audited.decided_by_rounding += sensitivity > regime::rounding_decides ? 1 : 0;
    }
    return audited;
}

}  // namespace

AuditedCell audit_tries(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::Job& job = scene.job();
    if (job.starts.count == 0 && job.uncertainty.rigs == 0) return {};
    const attractors::SolvedCell solved = with_ends(scene, row, column);
    const scene::Cell cell = scene.cell(row, column);
    constexpr std::int64_t draws = 1 << 15;
    const std::int64_t draw = (row * scene.columns() + column) % draws;
    AuditedCell audited;
    const auto from_start = [&](std::int64_t n) {
        return scene::Cell{cell.oscillator, attractors::start_of(job.starts, cell, n), cell.scales};
    };
    audited.starts = audit(solved.ends, job, draw, from_start,
                           [](const auto& a, const auto& b) { return regime::same_attractor(a, b); });
    if (job.uncertainty.rigs == 0) return audited;
    const scene::UncertainCells uncertain(job);
    const attractors::DrawnCells drawn(uncertain, job, row, column, cell.scales);
    audited.rigs = audit(
        solved.ends_of_rigs, job, draw, [&](std::int64_t n) { return drawn.cell(n); },
        [](const auto& a, const auto& b) { return regime::same_label(a, b); });
    return audited;
}

}  // namespace peterka
