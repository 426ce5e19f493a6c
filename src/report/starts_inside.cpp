#include "report/starts_inside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "support/readable.hpp"
#include "trajectory/contact_force.hpp"

namespace peterka {
namespace {

struct Starts {
    std::int64_t all = 0;
    std::int64_t inside = 0;
    double deepest = 0;  // penetration, in A0
    double force = 0;    // the largest at first, in k A0
};

// `count` starts as deep as those of two cells, between which the speed towards the stop is largest at an end.
void add(Starts& starts, std::int64_t count, const scene::Cell& one, const scene::Cell& other) {
    starts.all += count;
    if (!(one.start[0] > 0)) return;
    starts.inside += count;
    starts.deepest = std::max(starts.deepest, one.start[0]);
    for (const scene::Cell& cell : {one, other}) {
        starts.force = std::max(starts.force, trajectory::contact_force(cell.oscillator, cell.start));
    }
}

// How deep a start lies depends on the row alone: the gap; in a basin on the column alone: the displacement.
Starts find_starts(const scene::Scene& scene) {
    const job::Job& job = scene.job();
    Starts starts;
    if (job.kind == job::Kind::trace) {
        add(starts, 1, scene.cell(0, 0), scene.cell(0, 0));
        return starts;
    }
    const std::int64_t last_row = scene.rows() - 1;
    const std::int64_t last_column = scene.columns() - 1;
    if (job.kind == job::Kind::basin) {
        for (std::int64_t i = 0; i <= last_column; ++i) {
            add(starts, scene.rows(), scene.cell(0, i), scene.cell(last_row, i));
        }
        return starts;
    }
    const bool follows = job.kind == job::Kind::sweep && job.sweep.direction != job::Direction::independent;
    for (std::int64_t row = 0; row <= last_row; ++row) {
        if (follows) {  // a branch starts once, where it begins
            const bool down = job.sweep.branch(row).direction == job::Direction::down;
            const scene::Cell begin = scene.cell(row, down ? last_column : 0);
            add(starts, 1, begin, begin);
        } else {
            add(starts, scene.columns(), scene.cell(row, 0), scene.cell(row, last_column));
        }
    }
    return starts;
}

}  // namespace

std::string starts_inside(const scene::Scene& scene) {
    const Starts starts = find_starts(scene);
    if (starts.inside == 0) return "";
    const std::string which =
        starts.all == 1
            ? std::string("the hammer starts")
            : fmt::format("{} of {} starts lie", readable_count(starts.inside), readable_count(starts.all));
    return fmt::format("{} inside the stop, by up to {:.4g} A0 ({:.3g} mm): it presses with up to {} at once",
                       which, starts.deepest, starts.deepest * scene.scales().length_m * 1e3,
                       readable_amount(starts.force * scene.scales().force_n, "N", 3));
}

}  // namespace peterka
