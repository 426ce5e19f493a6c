#include "attractors/along_branch.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "attractors/known_motions.hpp"
#include "attractors/multi_start_pool.hpp"
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
    MultiStartPool pool(
        scene, none,
        [&](MultiStartPool::NumberedCell& cell) {
            solved[static_cast<std::size_t>(cell.number)] = std::move(cell.cell);
        },
        Ends::firsts);
    std::int64_t next = 0;
    while (next < scene.columns() || !pool.empty()) {
        look();
        while (next < scene.columns() && pool.has_room()) {
            pool.add(row, next, next);
            ++next;
        }
        pool.step();
    }
    return solved;
}

// Follows the motion once more: from its orbit, where there is one, otherwise from the start that first ended
// on it, which another engine may lead elsewhere.
SteadyMotion motion_of(const job::Job& job, scene::Cell cell, const FirstEnd& first,
                       const std::function<void()>& look) {
    const auto room = static_cast<std::size_t>(job.sweep.samples);
    const regime::CellResult& result = first.result;
    cell.start =
        regime::has_period(result.regime)
            ? scene::State<double>(result.orbit_displacement - cell.oscillator.gap, result.orbit_velocity)
        : first.start == Tally::no_start ? cell.start
                                         : start_of(job.starts, cell, first.start);
    SteadyMotion motion(room);
    regime::CycleBroker broker;
    const Task<regime::CellResult> search = regime::solve_cell(broker, job, cell, {}, &motion);
    regime::run(search, broker, look);
    return regime::same_attractor(result, search.result()) ? motion : SteadyMotion(room);
}

void tell_outcomes(PointAttractors& point, SolvedCell& solved) {
    point.of_rigs = solved.cell;
    point.outcomes = std::move(solved.outcomes);
}

void append(PointAttractors& point, const regime::CellResult& result, SteadyMotion motion) {
    point.kept.push_back(without_share(result));
    point.firsts.push_back({result, Tally::no_start});
    point.motions.push_back(std::move(motion));
}

void erase(PointAttractors& point, std::ptrdiff_t slot) {
    point.kept.erase(point.kept.begin() + slot);
    point.firsts.erase(point.firsts.begin() + slot);
    point.motions.erase(point.motions.begin() + slot);
}

// The attractors known from other points of the row and from the closed form, for each point.
std::vector<KnownMotions::NewResult> find_known(const scene::Scene& scene, std::int64_t row,
                                                const std::vector<PointAttractors>& points,
                                                const std::function<void()>& look) {
    KnownMotions known(scene, row, row + 1, look);
    std::vector<KnownMotions::CellMotion> news;
    std::int64_t cell = row * scene.columns();
    for (const PointAttractors& point : points) {
        std::vector<KnownMotion> here;
        for (const FirstEnd& first : point.firsts) here.push_back(KnownMotions::motion_of(first.result));
        for (const KnownMotion& motion : here) news.push_back({cell, motion});
        known.add(cell++, std::move(here));
    }
    std::vector<KnownMotions::NewResult> found = known.free_motions();
    while (!news.empty()) {
        const std::vector<KnownMotions::NewResult> more = known.spread(news);
        news.clear();
        for (const auto& each : more) news.push_back({each.cell, KnownMotions::motion_of(each.result)});
        found.insert(found.end(), more.begin(), more.end());
    }
    return found;
}

}  // namespace

std::vector<PointAttractors> find_along_branch(const scene::Scene& scene, std::int64_t row,
                                               const std::function<void()>& look) {
    job::Job job = scene.job();
    job.output.fields.clear();  // no optional field is kept for attractors' motions
    std::vector<PointAttractors> points;
    for (SolvedCell& solved : solve_row(scene, row, look)) {
        const scene::Cell cell = scene.cell(row, std::ssize(points));
        PointAttractors& point =
            points.emplace_back(PointAttractors{.count = solved.cell.attractors, .gap = cell.oscillator.gap});
        tell_outcomes(point, solved);
        point.kept = std::move(solved.attractors);
        point.firsts = std::move(solved.firsts);
        for (const FirstEnd& first : point.firsts) point.motions.push_back(motion_of(job, cell, first, look));
    }
    for (const auto& [number, result] : find_known(scene, row, points, look)) {
        const std::int64_t column = number - row * scene.columns();
        append(points[static_cast<std::size_t>(column)], result,
               motion_of(job, scene.cell(row, column), {result, Tally::no_start}, look));
    }
    return points;
}

std::vector<PointAttractors> find_outcomes_along_branch(const scene::Scene& scene, std::int64_t row,
                                                        const std::function<void()>& look) {
    std::vector<PointAttractors> points;
    for (SolvedCell& solved : solve_row(scene, row, look)) tell_outcomes(points.emplace_back(), solved);
    return points;
}

void keep_with(PointAttractors& point, std::span<const regime::BranchPoint* const> branches,
               std::int64_t most) {
    for (const regime::BranchPoint* branch : branches) {
        if (slot_of(point, branch->cell) < 0 && cell::is_motion(branch->cell.regime))
            append(point, branch->cell, branch->motion);
    }
    const auto gives_way = [&](std::ptrdiff_t slot) {
        return point.kept[static_cast<std::size_t>(slot)].share > 0 &&
               std::ranges::none_of(branches,
                                    [&](const auto* branch) { return slot_of(point, branch->cell) == slot; });
    };
    for (std::ptrdiff_t slot = std::ssize(point.kept) - 1; slot > 0 && std::ssize(point.kept) > most; --slot) {
        if (gives_way(slot)) erase(point, slot);
    }
    while (std::ssize(point.kept) > most) erase(point, std::ssize(point.kept) - 1);
}

std::int32_t slot_of(const PointAttractors& point, const cell::CellResult& motion) {
    const auto same = std::ranges::find_if(
        point.firsts, [&](const FirstEnd& first) { return regime::same_attractor(first.result, motion); });
    return same == point.firsts.end() ? -1 : static_cast<std::int32_t>(same - point.firsts.begin());
}

}  // namespace peterka::attractors
