#include "attractors/along_branch.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "attractors/cell_crowd.hpp"
#include "attractors/start_sequence.hpp"
#include "attractors/tally.hpp"
#include "regime/same_attractor.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"

namespace peterka::attractors {

namespace {

using regime::SteadyMotion;

std::vector<SolvedCell> solve_row(const scene::Scene& scene, std::int64_t row,
                                  const std::function<void()>& look) {
    std::vector<SolvedCell> solved(static_cast<std::size_t>(scene.columns()));
    const regime::AttractorTable none;
    CellCrowd crowd(
        scene, none,
        [&](CellCrowd::Solved cell) { solved[static_cast<std::size_t>(cell.number)] = std::move(cell.cell); },
        Ends::firsts);
    std::int64_t next = 0;
    while (next < scene.columns() || !crowd.empty()) {
        look();
        while (next < scene.columns() && crowd.has_room()) {
            crowd.add(row, next, next);
            ++next;
        }
        crowd.step();
    }
    return solved;
}

// Followed once more: from the orbit itself, where there is one, else from the start that ended on it first,
// which another engine may lead elsewhere.
SteadyMotion motion_of(const job::Job& job, scene::Cell cell, const FirstEnd& first,
                       const std::function<void()>& look) {
    const auto room = static_cast<std::size_t>(job.sweep.samples);
    const regime::CellResult& result = first.result;
    cell.start =
        regime::has_period(result.regime)
        ? scene::State<double>(result.orbit_displacement - cell.oscillator.gap, result.orbit_velocity)
        : first.start == Tally::no_start ? cell.start
                                         : start_of(job.starts, cell.oscillator, first.start);
    SteadyMotion motion(room);
    regime::CycleDesk desk;
    const Task<regime::CellResult> search = regime::solve_cell(desk, job, cell, {}, &motion);
    regime::run(search, desk, look);
    return regime::same_attractor(result, search.result()) ? motion : SteadyMotion(room);
}

}  // namespace

std::vector<PointAttractors> find_along_branch(const scene::Scene& scene, std::int64_t row,
                                               const std::function<void()>& look) {
    job::Job job = scene.job();
    job.output.fields.clear();  // none of them is kept of attractors' motions
    std::vector<PointAttractors> points;
    for (SolvedCell& solved : solve_row(scene, row, look)) {
        const scene::Cell cell = scene.cell(row, std::ssize(points));
        PointAttractors& point =
            points.emplace_back(PointAttractors{.count = solved.cell.attractors, .gap = cell.oscillator.gap});
        point.kept = std::move(solved.attractors);
        point.firsts = std::move(solved.firsts);
        for (const FirstEnd& first : point.firsts) point.motions.push_back(motion_of(job, cell, first, look));
    }
    return points;
}

std::int32_t slot_of(const PointAttractors& point, const cell::CellResult& motion) {
    const auto same = std::ranges::find_if(
        point.firsts, [&](const FirstEnd& first) { return regime::same_attractor(first.result, motion); });
    return same == point.firsts.end() ? -1 : static_cast<std::int32_t>(same - point.firsts.begin());
}

}  // namespace peterka::attractors
