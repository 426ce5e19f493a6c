#include "run/commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job/remarks.hpp"
#include "job/twins.hpp"
#include "job/write.hpp"
#include "map_file/layout.hpp"
#include "map_file/map_size.hpp"
#include "refine/lattice.hpp"
#include "report/axis_words.hpp"
#include "report/starts_inside.hpp"
#include "run/memory_left.hpp"
#include "run/price.hpp"
#include "run/require_memory.hpp"
#include "run/run_plan.hpp"
#include "run/traced_cell.hpp"
#include "scene/scene.hpp"
#include "study/topic.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

std::string free_space_text(const std::filesystem::path& file) {
    std::error_code unknown;
    const auto space = std::filesystem::space(map_file::folder_of(file), unknown);
    if (unknown) return "its folder cannot be read";
    return readable_bytes(static_cast<std::int64_t>(space.available)) + " free there";
}

// For a refined map: the number and grid of the cells that are always computed; at most all of them are.
std::string refine_text(const job::Job& job) {
    if (job.refine.levels == 0) return "";
    const std::int64_t stride = std::int64_t{1} << job.refine.levels;
    const std::int64_t coarsest =
        refine::Lattice(job.rows.points, stride).lines() * refine::Lattice(job.columns.points, stride).lines();
    return fmt::format("#   refine   from a grid of stride {}, {} cells, to all of them where it must\n",
                       stride, readable_count(coarsest));
}

std::string gap_of_branch(const job::Job& job, const job::Branch& branch) {
    if (!branch.gap) return "";
    const auto twin = job::twin_of_branches(job);
    const bool in_m = job.sweep.gap_key() == "gap_m";
    const double other = twin ? twin->value(*branch.gap) : 0;
    if (!twin)
        return in_m ? fmt::format("gap {:.4g} mm, ", 1e3 * *branch.gap)
                    : fmt::format("gap/A0 {:g}, ", *branch.gap);
    return gap_in_words(job, in_m ? other : *branch.gap, in_m ? *branch.gap : other) + ", ";
}

// For a sweep: its branches in their order.
std::string branches_text(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return "";
    std::string text;
    for (std::int64_t i = 0; i < job.sweep.branches(); ++i) {
        const job::Branch branch = job.sweep.branch(i);
        text += fmt::format("#     {:<4} {}{}\n", i, gap_of_branch(job, branch), job::name(branch.direction));
    }
    return "#   branches\n" + text;
}

// For a job whose cells have springs, dampers or stops of their own.
std::string rigs_text(const job::Job& job) {
    if (job.kind == job::Kind::sweep) return "";
    if (!scene::Scene(job).rigs_differ()) return "";
    return "#   rigs     cells have their own\n";
}

// For a basin that has the rig and the place of a cell of a map.
std::string cell_text(const TracedCell& traced) {
    if (!traced.rig) return "";
    return fmt::format("#   rig      that of {}\n", *traced.rig);
}

std::string remarks_text(const job::Job& job) {
    std::string text;
    for (const std::string& remark : job::remarks(job)) text += fmt::format("#   note     {}\n", remark);
    return text;
}

// For the plane, the branches or the one cell of a job.
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
               "{}{}"
               "#   curves   of all that are found, with periods of up to {} cycles (curves.max_period), "
               "dealt to the ranks\n"
               "{}"
               "#   memory   about {} per rank, on any number of ranks\n"
               "#   file     {}, {} at most ({})\n"
               "{}\n",
               request.job_file.string(), readable_count(job.cells()), readable_count(job.columns.points),
               readable_count(job.row_count()), starts_price(job), time_price(job), job.curves.max_period,
               crossings_price(job), readable_bytes(memory_per_rank(job)), map_file_of(request).string(),
               readable_bytes(largest_curves_file(job)), free_space_text(map_file_of(request)),
               remarks_text(job)) +
           job::resolved_text(job, origins);
}

std::string check_trace(const Request& request, const TracedCell& traced, const job::Origins& origins) {
    std::string cell = "of one cell, that of this job";
    if (traced.map) {
        const std::string stored = fmt::format("row {}, column {} of {}", traced.map->row, traced.map->column,
                                               traced.map->file.string());
        cell = traced.map->asked_beside.empty()
                   ? "of one cell, that of " + stored
                   : fmt::format("of the place asked for, {} from {}", traced.map->asked_beside, stored);
    }
    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   trace    {}\n"
               "{}"
               "#   file     {} ({})\n"
               "{}\n",
               request.job_file.string(), cell, starts_text(traced.job), map_file_of(request).string(),
               free_space_text(map_file_of(request)), remarks_text(traced.job)) +
           job::resolved_text(traced.job, origins);
}

}  // namespace

std::string check_job(const Request& request) {
    auto [read, origins] = job::read_job_with_origins(request.job_file, request.overrides);
    const TracedCell traced = find_traced_cell(read);
    const job::Job& job = traced.job;
    if (traced.rig) job::take_from(read.cell.map, job, origins);
    if (job.kind == job::Kind::study) return check_study(request, job, origins);
    if (job.kind == job::Kind::trace) return check_trace(request, traced, origins);
    require_memory(request.job_file.string(), job);
    if (job.kind == job::Kind::curves) return check_curves(request, job, origins);
    const auto file = map_file_of(request);
    const auto axes = job::axis_names(job);
    const parallel::Tiling tiling = map_file::tiling(job);

    return fmt::format(
               "# {} is a sound job. It would be computed as follows.\n"
               "#   cells    {}: {} of {} by {} of {}\n"
               "{}{}{}{}{}{}{}{}{}{}{}{}"
               "#   tiles    {} of {} by {} cells, dealt to the ranks\n"
               "#   memory   about {} per rank, on any number of ranks; {} is left here\n"
               "#   file     {}, {} ({})\n"
               "{}\n",
               request.job_file.string(), readable_count(job.cells()), readable_count(job.columns.points),
               axes.columns, readable_count(job.row_count()), axes.rows, cell_text(traced), refine_text(job),
               branches_text(job), rigs_text(job), starts_text(job), starts_price(job), rigs_price(job),
               time_price(job), long_chaos_price(job), noise_price(job), certificate_price(job),
               crossings_price(job), readable_count(tiling.count()), tiling.largest_tile().rows,
               tiling.largest_tile().columns, readable_bytes(memory_per_rank(job)),
               readable_bytes(memory_left_to_all().bytes), file.string(),
               readable_bytes(map_file::predicted_bytes(job)), free_space_text(file), remarks_text(job)) +
           job::resolved_text(job, origins);
}

}  // namespace peterka
