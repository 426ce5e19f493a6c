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
    double deepest_m = 0;
    double force_n = 0;  // the largest initial force
};

// `count` starts between two cells, both inside or both outside the stop; the extremes are at these two.
void add(Starts& starts, std::int64_t count, const scene::Cell& one, const scene::Cell& other) {
    starts.all += count;
    if (!(one.start[0] > 0)) return;
    starts.inside += count;
    for (const scene::Cell& cell : {one, other}) {
        starts.deepest_m = std::max(starts.deepest_m, cell.start[0] * cell.scales.length_m);
        starts.deepest = std::max(starts.deepest, cell.start[0]);
        starts.force_n = std::max(starts.force_n,
                                  trajectory::contact_force(cell.oscillator, cell.start) * cell.scales.force_n);
    }
}

// A row: the depth of the starts is monotonic along it, so those inside are its first or its last ones.
void add_row(Starts& starts, const scene::Scene& scene, std::int64_t row) {
    const std::int64_t columns = scene.columns();
    const auto inside = [&](std::int64_t column) { return scene.cell(row, column).start[0] > 0; };
    const bool first_inside = inside(0);
    std::int64_t change = columns;  // the first column that differs from column 0
    if (inside(columns - 1) != first_inside) {
        std::int64_t same = 0;
        for (change = columns - 1; change - same > 1;) {
            const std::int64_t middle = same + (change - same) / 2;
            (inside(middle) == first_inside ? same : change) = middle;
        }
    }
    add(starts, change, scene.cell(row, 0), scene.cell(row, change - 1));
    if (change < columns) {
        add(starts, columns - change, scene.cell(row, change), scene.cell(row, columns - 1));
    }
}

Starts find_starts(const scene::Scene& scene) {
    const job::Job& job = scene.job();
    Starts starts;
    if (job.kind == job::Kind::trace) {
        add(starts, 1, scene.cell(0, 0), scene.cell(0, 0));
        return starts;
    }
    const bool follows = job.kind == job::Kind::sweep && job.sweep.direction != job::Direction::independent;
    for (std::int64_t row = 0; row < scene.rows(); ++row) {
        if (follows) {  // a branch starts once, where it begins
            const bool down = job.sweep.branch(row).direction == job::Direction::down;
            const scene::Cell begin = scene.cell(row, down ? scene.columns() - 1 : 0);
            add(starts, 1, begin, begin);
        } else {
            add_row(starts, scene, row);
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
    const double millimetres = starts.deepest_m * 1e3;
    const std::string depth = job::leads_in_si(scene.job())
                                  ? fmt::format("{:.4g} mm ({:.3g} A0)", millimetres, starts.deepest)
                                  : fmt::format("{:.4g} A0 ({:.3g} mm)", starts.deepest, millimetres);
    return fmt::format("{} inside the stop, by up to {}: it presses with up to {} at once", which, depth,
                       readable_amount(starts.force_n, "N", 3));
}

}  // namespace peterka
