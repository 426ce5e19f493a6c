#include "run/price.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "attractors/along_branch.hpp"
#include "job/branches.hpp"
#include "map_file/layout.hpp"
#include "map_file/samples.hpp"
#include "refine/region.hpp"
#include "refine/regions.hpp"
#include "regime/branch.hpp"
#include "regime/engine.hpp"
#include "scene/scene.hpp"
#include "support/errors.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

// Of a process [bytes].
struct Taken {
    std::int64_t address_space = 0;
    std::int64_t resident = 0;
};

Taken taken() {
    Taken pages;
    std::ifstream("/proc/self/statm") >> pages.address_space >> pages.resident;
    const std::int64_t page = sysconf(_SC_PAGESIZE);
    return {pages.address_space * page, pages.resident * page};
}

// What hundreds of cells in hand take, where they are solved side by side [bytes]; as measured.
std::int64_t cells_in_hand_bytes(const job::Job& job) {
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    const bool one_by_one = job.kind == job::Kind::sweep && job.starts.count == 0;
    if (one_by_one || !regime::may_use_batch(rig, job.solver)) return 0;
    return job.kind == job::Kind::basin ? 4'000'000 : 26'000'000;
}

// Cells are open until all their starts have ended, with the results of a round of these; tiles in hand have
// all attractors that are kept; an audited cell tells the ends of all its starts [bytes].
std::int64_t starts_bytes(const job::Job& job) {
    if (job.starts.count == 0) return 0;
    const std::int64_t open_cells = std::min<std::int64_t>(800, job.cells());
    const std::int64_t largest_round = std::clamp<std::int64_t>(job.starts.count / 5, 8, 256);
    constexpr std::int64_t result = 1000;
    const std::int64_t tiles = parallel::tile_extent.rows * parallel::tile_extent.columns * 16;
    const std::int64_t kept =
        job.starts.attractors * static_cast<std::int64_t>(sizeof(attractors::CellAttractor));
    constexpr auto end = static_cast<std::int64_t>(sizeof(regime::CellResult));
    const std::int64_t told = job.audit.cells > 0 ? 2 * end * job.starts.count : 0;
    const bool has_kicks = job.output.has(job::OptionalField::critical_kick);
    const std::int64_t kicks = has_kicks ? 30'000'000 : 0;  // of cells whose kicks wait, as measured
    return open_cells * largest_round * result + 2 * tiles * kept + told + kicks;
}

// A rank keeps regions of a refined map until they are whole.
std::int64_t region_bytes(const job::Job& job) {
    if (job.refine.levels == 0) return 0;
    const parallel::Tiling regions = refine::regions_of({job.rows.points, job.columns.points}, 1);
    const parallel::Place middle{job.rows.points / 2, job.columns.points / 2};
    const auto in_hand = std::min(static_cast<std::int64_t>(refine::most_in_hand), regions.count());
    return in_hand * refine::Region::bytes(job, regions.tile(regions.index_at(middle)));
}

// A rank keeps a branch of a sweep until it is whole: as samples, and as the bytes of its tile. With [starts]
// all branches of a gap, and each point's attractors with the motions on them.
std::int64_t branch_bytes(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return 0;
    constexpr std::int64_t copies = 3;
    constexpr auto number = static_cast<std::int64_t>(sizeof(double));
    const std::int64_t samples = std::ssize(map_file::stored_sample_variables(job)) * job.sweep.samples;
    const std::int64_t point =
        copies * samples * number + static_cast<std::int64_t>(sizeof(regime::BranchPoint));
    if (job.starts.count == 0) return job.columns.points * point;
    const std::int64_t motion =
        static_cast<std::int64_t>(sizeof(attractors::FirstEnd) + sizeof(regime::SteadyMotion)) +
        4 * number * job.sweep.samples;
    return job.columns.points *
           (job::branches_of_a_gap(job.sweep) * point + job.starts.attractors * motion +
            static_cast<std::int64_t>(sizeof(attractors::PointAttractors) + sizeof(attractors::SolvedCell)));
}

// Each rank keeps the coarse map of curves: on its way between ranks, as motions, and rank 0 as a file [bytes].
// 260 a cell were measured.
std::int64_t coarse_map_bytes(const job::Job& job) {
    if (job.kind != job::Kind::curves) return 0;
    const std::int64_t of_cell = job.starts.count > 0 ? 1000 : 400;
    return job.cells() * of_cell;
}

// Of /proc/meminfo; nothing said, no limit.
std::int64_t available_in_machine() {
    std::ifstream info("/proc/meminfo");
    for (std::string name; info >> name;) {
        std::int64_t kilobytes = 0;
        if (name == "MemAvailable:" && info >> kilobytes) return kilobytes * 1024;
    }
    return std::numeric_limits<std::int64_t>::max();
}

std::int64_t left_below(int limit_of, std::int64_t taken) {
    rlimit limit{};
    if (getrlimit(static_cast<__rlimit_resource_t>(limit_of), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::numeric_limits<std::int64_t>::max();
    return std::max<std::int64_t>(static_cast<std::int64_t>(limit.rlim_cur) - taken, 0);
}

}  // namespace

// What this process has so far, that is program, MPI and HDF5; what opening the file through MPI-IO adds (3 MB
// were measured); cells in hand; and while ranks look for missing tiles, two bits for each. Not by getrusage,
// whose peak is that of the process that started this one, if that is larger.
std::int64_t memory_per_rank(const job::Job& job) {
    constexpr std::int64_t open_file = 3'000'000;
    return taken().resident + open_file + cells_in_hand_bytes(job) + map_file::tiling(job).count() / 4 +
           region_bytes(job) + branch_bytes(job) + starts_bytes(job) + coarse_map_bytes(job);
}

std::int64_t largest_curves_file(const job::Job& job) {
    constexpr std::int64_t all_curves = 50'000'000;  // far above any
    const std::int64_t of_cell = job.curves.edge_distance ? 35 : 17;
    return all_curves + job.cells() * of_cell;
}

std::int64_t memory_left() {
    const Taken so_far = taken();
    return std::min({available_in_machine(), left_below(RLIMIT_AS, so_far.address_space),
                     left_below(RLIMIT_DATA, so_far.resident)});
}

void require_memory(const std::string& where, const job::Job& job) {
    using enum job::Kind;
    if (job.kind != map && job.kind != basin && job.kind != sweep && job.kind != curves) return;
    const std::int64_t needed = memory_per_rank(job) - taken().resident;
    const std::int64_t left = memory_left();
    if (needed <= left) return;
    std::string ways = "fewer points";
    if (job.starts.count > 0) ways += ", a smaller starts.count or starts.attractors";
    if (job.kind == job::Kind::sweep) ways += ", a smaller sweep.samples";
    throw Failure(ExitCode::bad_job,
                  fmt::format("{}: a rank needs {} of memory, and this machine, or a limit of this process "
                              "(ulimit -v), leaves {}; nothing was created. Give {}, or compute it where there "
                              "is more.",
                              where, readable_bytes(needed), readable_bytes(left), ways));
}

// Microseconds and core of a start as measured on the paper's rig with AVX2; with AVX-512 about half. Other
// laws, engines and strong cubic springs take many times as long. A cell whose starts settle at once takes a
// twentieth of the mean, a chaotic one ten times as long: of few cells the mean tells little.
std::string starts_price(const job::Job& job) {
    if (job.starts.count == 0) return "";
    constexpr double microseconds = 15;
    constexpr double enough = 100;
    constexpr double of_kicks = 400;  // starts that take as long as all kicks of a cell, as measured
    const bool kicks = job.output.has(job::OptionalField::critical_kick);
    const bool is_sweep = job.kind == job::Kind::sweep;
    const auto shared = static_cast<double>(is_sweep ? job::branches_of_a_gap(job.sweep) : 1);
    const double cells = static_cast<double>(job.cells()) / shared;
    const double starts = static_cast<double>(job.starts.count) * cells;
    const double seconds = (starts + (kicks ? of_kicks * cells : 0)) * microseconds * 1e-6;
    const std::string words =
        cells < enough
            ? fmt::format("from {} to {} of one core: few cells may all settle at once, or all be chaotic",
                          readable_duration(seconds / 20), readable_duration(seconds * 10))
            : fmt::format("some {} of one core, about", readable_duration(seconds));
    return fmt::format("#   starts   {} in each {}, {:.3g} in all{}: {}\n", readable_count(job.starts.count),
                       is_sweep ? "point" : "cell", starts, kicks ? ", and critical kicks" : "", words);
}

}  // namespace peterka
