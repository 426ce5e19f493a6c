#include "run/check_job.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <variant>

#include "attractors/solved_cell.hpp"
#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job/write.hpp"
#include "map_file/layout.hpp"
#include "map_file/map_size.hpp"
#include "map_file/samples.hpp"
#include "refine/lattice.hpp"
#include "refine/region.hpp"
#include "refine/regions.hpp"
#include "regime/branch.hpp"
#include "regime/engine.hpp"
#include "report/starts_inside.hpp"
#include "run/run_plan.hpp"
#include "run/traced_cell.hpp"
#include "scene/rigs.hpp"
#include "scene/scene.hpp"
#include "study/topic.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

// What hundreds of cells in hand take, where they are solved side by side [bytes]; as measured.
std::int64_t cells_in_hand_bytes(const job::Job& job) {
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    if (job.kind == job::Kind::sweep || !regime::may_use_batch(rig, job.solver)) return 0;
    return job.kind == job::Kind::basin ? 4'000'000 : 26'000'000;
}

// What a rank needs [bytes]: what this process has so far, that is program, MPI and HDF5; what opening the file
// through MPI-IO adds (3 MB were measured); cells in hand; and while ranks look for missing tiles, two bits for
// each. Not by getrusage, whose peak is that of the process that started this one, if that is larger.
std::int64_t memory_per_rank(const job::Job& job, std::int64_t tiles) {
    constexpr std::int64_t open_file = 3'000'000;
    std::int64_t pages = 0;
    std::int64_t resident_pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident_pages;
    return resident_pages * sysconf(_SC_PAGESIZE) + open_file + cells_in_hand_bytes(job) + tiles / 4;
}

std::string free_space_text(const std::filesystem::path& file) {
    std::error_code unknown;
    const auto space = std::filesystem::space(map_file::folder_of(file), unknown);
    if (unknown) return "its folder cannot be read";
    return readable_bytes(static_cast<std::int64_t>(space.available)) + " free there";
}

// Of a refined map: how many cells are surely computed, and where; all of them at most.
std::string refine_text(const job::Job& job) {
    if (job.refine.levels == 0) return "";
    const std::int64_t stride = std::int64_t{1} << job.refine.levels;
    const std::int64_t coarsest =
        refine::Lattice(job.rows.points, stride).lines() * refine::Lattice(job.columns.points, stride).lines();
    return fmt::format("#   refine   from a grid of stride {}, {} cells, to all of them where it must\n",
                       stride, readable_count(coarsest));
}

// Of a map with [starts]: what they cost. Microseconds and core of a start as measured on the paper's rig,
// where the machine has AVX-512; other laws, engines and strong cubic springs take many times as long.
std::string starts_price(const job::Job& job) {
    if (job.starts.count == 0) return "";
    constexpr double microseconds = 9;
    const double starts = static_cast<double>(job.starts.count) * static_cast<double>(job.cells());
    return fmt::format("#   starts   {} in each cell, {:.3g} in all: some {} of one core, about\n",
                       readable_count(job.starts.count), starts,
                       readable_duration(starts * microseconds * 1e-6));
}

// Cells are open until all their starts have ended, with the results of a round of these [bytes].
std::int64_t starts_bytes(const job::Job& job) {
    if (job.starts.count == 0) return 0;
    const std::int64_t open_cells = std::min<std::int64_t>(800, job.cells());
    constexpr std::int64_t largest_round = 448;
    constexpr std::int64_t result = 1000;
    const std::int64_t tiles = parallel::tile_extent.rows * parallel::tile_extent.columns * 16;
    const std::int64_t kept =
        job.starts.attractors * static_cast<std::int64_t>(sizeof(attractors::CellAttractor));
    return open_cells * std::min(job.starts.count + 1, largest_round) * result + 2 * tiles * kept;
}

// A rank keeps regions of a refined map until they are whole.
std::int64_t region_bytes(const job::Job& job) {
    if (job.refine.levels == 0) return 0;
    const parallel::Tiling regions = refine::regions_of({job.rows.points, job.columns.points}, 1);
    const parallel::Place middle{job.rows.points / 2, job.columns.points / 2};
    const auto in_hand = std::min(static_cast<std::int64_t>(refine::most_in_hand), regions.count());
    return in_hand * refine::Region::bytes(job, regions.tile(regions.index_at(middle)));
}

// A rank keeps a branch of a sweep until it is whole: as samples, and as the bytes of its tile.
std::int64_t branch_bytes(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return 0;
    constexpr std::int64_t copies = 3;
    const std::int64_t samples = std::ssize(map_file::sample_variables) * job.sweep.samples;
    const std::int64_t point = copies * samples * static_cast<std::int64_t>(sizeof(double));
    return job.columns.points * (point + static_cast<std::int64_t>(sizeof(regime::BranchPoint)));
}

// Of a sweep: its branches in their order.
std::string branches_text(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return "";
    std::string text;
    for (std::int64_t i = 0; i < job.sweep.branches(); ++i) {
        const job::Branch branch = job.sweep.branch(i);
        const std::string gap =
            std::isnan(branch.gap_ratio) ? "" : fmt::format("gap/A0 {:g}, ", branch.gap_ratio);
        text += fmt::format("#     {:<4} {}{}\n", i, gap, job::name(branch.direction));
    }
    return "#   branches\n" + text;
}

// Of a job whose cells have springs, dampers or stops of their own.
std::string rigs_text(const job::Job& job) {
    if (job.kind == job::Kind::sweep) return "";
    const scene::Rigs rigs = scene::rigs_of(scene::Scene(job));
    if (rigs == scene::Rigs::one) return "";
    const bool of_lines = rigs == scene::Rigs::of_lines;
    return fmt::format(
        "#   rigs     {}: a cycle takes about {} times as long as in a map with one rig\n",
        of_lines ? "each line of cells has its own" : "each cell has its own and is solved alone",
        of_lines ? 5 : 8);
}

// Of a basin that has the rig and the place of a cell of a map.
std::string cell_text(const TracedCell& traced) {
    if (!traced.rig) return "";
    return fmt::format("#   rig      that of row {}, column {} of {}\n", traced.rig->cell.row,
                       traced.rig->cell.column, traced.rig->file.string());
}

// Of the plane, the branches or the one cell of a job.
std::string starts_text(const job::Job& job) {
    const std::string inside = starts_inside(scene::Scene(job));
    return inside.empty() ? "" : fmt::format("#   starts   {}\n", inside);
}

std::string check_study(const Request& request, const job::Job& job, const job::Origins& origins) {
    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   runs     {}, dealt to the ranks\n"
               "#   file     {} ({})\n\n",
               request.job_file.string(), readable_count(study::count_tasks(job)),
               map_file_of(request).string(), free_space_text(map_file_of(request))) +
           job::resolved_text(job, origins);
}

std::string check_curves(const Request& request, const job::Job& job, const job::Origins& origins) {
    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   orbits   looked for in a coarse map of {} cells, {} by {}\n"
               "#   curves   of all that are found, up to q = {}, dealt to the ranks\n"
               "#   file     {} ({})\n\n",
               request.job_file.string(), readable_count(job.cells()), readable_count(job.columns.points),
               readable_count(job.row_count()), job.curves.max_period, map_file_of(request).string(),
               free_space_text(map_file_of(request))) +
           job::resolved_text(job, origins);
}

std::string check_trace(const Request& request, const TracedCell& traced, const job::Origins& origins) {
    const std::string cell = traced.map ? fmt::format("of row {}, column {} of {}", traced.map->row,
                                                      traced.map->column, traced.map->file.string())
                                        : std::string("of this job");
    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   trace    of one cell, that {}\n"
               "{}"
               "#   file     {} ({})\n\n",
               request.job_file.string(), cell, starts_text(traced.job), map_file_of(request).string(),
               free_space_text(map_file_of(request))) +
           job::resolved_text(traced.job, origins);
}

}  // namespace

std::string check_job(const Request& request) {
    auto [read, origins] = job::read_job_with_origins(request.job_file, request.overrides);
    const TracedCell traced = find_traced_cell(read);
    const job::Job& job = traced.job;
    if (traced.rig) job::take_from(traced.rig->file.string(), job, origins);
    if (job.kind == job::Kind::study) return check_study(request, job, origins);
    if (job.kind == job::Kind::curves) return check_curves(request, job, origins);
    if (job.kind == job::Kind::trace) return check_trace(request, traced, origins);
    const auto file = map_file_of(request);
    const auto axes = job::axis_names(job);
    const parallel::Tiling tiling = map_file::tiling(job);

    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   cells    {}: {} of {} by {} of {}\n"
               "{}{}{}{}{}{}"
               "#   tiles    {} of {} by {} cells, dealt to the ranks\n"
               "#   memory   about {} per rank, on any number of ranks\n"
               "#   file     {}, {} ({})\n\n",
               request.job_file.string(), readable_count(job.cells()), readable_count(job.columns.points),
               axes.columns, readable_count(job.row_count()), axes.rows, cell_text(traced), refine_text(job),
               branches_text(job), rigs_text(job), starts_text(job), starts_price(job),
               readable_count(tiling.count()), tiling.largest_tile().rows, tiling.largest_tile().columns,
               readable_bytes(memory_per_rank(job, tiling.count()) + region_bytes(job) + branch_bytes(job) +
                              starts_bytes(job)),
               file.string(), readable_bytes(map_file::predicted_bytes(job)), free_space_text(file)) +
           job::resolved_text(job, origins);
}

}  // namespace peterka
