#include "run/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "attractors/along_branch.hpp"
#include "job/branches.hpp"
#include "map_file/layout.hpp"
#include "map_file/samples.hpp"
#include "refine/region.hpp"
#include "refine/regions.hpp"
#include "regime/branch.hpp"
#include "regime/cycles_for_chaos.hpp"
#include "regime/engine.hpp"
#include "report/outcomes_summary.hpp"
#include "run/memory_left.hpp"
#include "run/sampled_cost.hpp"
#include "scene/scene.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

// Memory of hundreds of cells in progress, where they are solved side by side [bytes]; as measured.
std::int64_t cells_in_hand_bytes(const job::Job& job) {
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    const bool one_by_one = job.kind == job::Kind::sweep && job.starts.count == 0 && job.uncertainty.rigs == 0;
    if (one_by_one || !regime::may_use_batch(rig, job.solver)) return 0;
    return job.kind == job::Kind::basin ? 4'000'000 : 26'000'000;
}

// Cells stay open until all their starts have ended, with the results of one round of starts; tiles in progress
// hold all attractors that are kept; an audited cell returns the ends of all its starts [bytes].
std::int64_t starts_bytes(const job::Job& job) {
    const bool has_kicks = job.output.has(job::OptionalField::critical_kick);
    if (job.starts.count == 0 && !has_kicks) return 0;
    const std::int64_t open_cells = std::min<std::int64_t>(800, job.cells());
    const std::int64_t largest_round = std::clamp<std::int64_t>(job.starts.count / 5, 8, 256);
    constexpr std::int64_t result = 1000;
    const std::int64_t tiles = parallel::tile_extent.rows * parallel::tile_extent.columns * 16;
    const std::int64_t kept =
        job.starts.attractors * static_cast<std::int64_t>(sizeof(attractors::CellAttractor));
    constexpr auto end = static_cast<std::int64_t>(sizeof(regime::CellResult));
    const std::int64_t told = job.audit.cells > 0 ? 2 * end * job.starts.count : 0;
    const std::int64_t kicks = has_kicks ? 30'000'000 : 0;  // of cells whose kicks are pending, as measured
    return open_cells * largest_round * result + 2 * tiles * kept + told + kicks;
}

// The searches of the drawn rigs of open cells, and lanes for rigs of their own [bytes]; as measured with 64
// and 512 rigs.
std::int64_t rigs_bytes(const job::Job& job) {
    return job.uncertainty.rigs == 0 ? 0 : 12'000'000 + 90'000 * job.uncertainty.rigs;
}

// A rank keeps the regions of a refined map until they are complete.
std::int64_t region_bytes(const job::Job& job) {
    if (job.refine.levels == 0) return 0;
    const parallel::Tiling regions = refine::regions_of({job.rows.points, job.columns.points}, 1);
    const parallel::CellIndex middle{job.rows.points / 2, job.columns.points / 2};
    const auto in_hand = std::min(static_cast<std::int64_t>(refine::most_in_hand), regions.count());
    return in_hand * refine::Region::bytes(job, regions.tile(regions.index_at(middle)));
}

// A rank keeps a branch of a sweep until it is complete: as samples, and as the bytes of its tile. With
// [starts], all branches of a gap, and each point's attractors with the motions on them.
std::int64_t branch_bytes(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return 0;
    constexpr std::int64_t copies = 3;
    constexpr auto number = static_cast<std::int64_t>(sizeof(double));
    const std::int64_t samples = std::ssize(map_file::stored_sample_variables(job)) * job.sweep.samples;
    const std::int64_t point =
        copies * samples * number + static_cast<std::int64_t>(sizeof(regime::BranchPoint));
    if (job.starts.count == 0) {
        const std::int64_t branches = job.uncertainty.rigs > 0 ? job::branches_of_a_gap(job.sweep) : 1;
        return job.columns.points * branches * point;
    }
    const std::int64_t motion =
        static_cast<std::int64_t>(sizeof(attractors::FirstEnd) + sizeof(regime::SteadyMotion)) +
        4 * number * job.sweep.samples;
    return job.columns.points *
           (job::branches_of_a_gap(job.sweep) * point + job.starts.attractors * motion +
            static_cast<std::int64_t>(sizeof(attractors::PointAttractors) + sizeof(attractors::SolvedCell)));
}

// Each rank keeps the coarse map of curves: in transit between ranks, as motions, and on rank 0 as a file
// [bytes]. 260 per cell were measured.
std::int64_t coarse_map_bytes(const job::Job& job) {
    if (job.kind != job::Kind::curves) return 0;
    const std::int64_t of_cell = job.starts.count > 0 ? 1000 : 400;
    return job.cells() * of_cell;
}

// Cost of kicks on the plane of the paper's rig of 170 mm (16 x 16 cells, 16 starts), in cycles of the batch:
// 850,000 for all attractors of a cell, mostly for long chaotic returns; and 34,000 for its own motion, each at
// twice the time, as the kicks of one orbit fill the lanes less evenly.
double cycles_of_kicks(const job::Job& job) {
    if (!job.output.has(job::OptionalField::critical_kick)) return 0;
    return job.starts.count > 0 ? 850'000 : 68'000;
}

// Where several branches share a gap, so do their starts and rigs.
std::string each_in_words(const job::Job& job, std::int64_t count, std::string_view what) {
    const bool is_sweep = job.kind == job::Kind::sweep;
    const std::int64_t cells = job.cells() / (is_sweep ? job::branches_of_a_gap(job.sweep) : 1);
    return fmt::format("{}{} in each {}, {} in all", readable_count(count), what, is_sweep ? "point" : "cell",
                       readable_count(count * cells));
}

}  // namespace

// What this process has so far, i.e. program, MPI and HDF5; what opening the file through MPI-IO adds (3 MB
// were measured); cells in progress; and two bits per tile while ranks look for missing tiles. Not by
// getrusage, whose peak is that of the parent process, if that is larger.
std::int64_t memory_per_rank(const job::Job& job) {
    constexpr std::int64_t open_file = 3'000'000;
    return resident_bytes() + open_file + cells_in_hand_bytes(job) + map_file::tiling(job).count() / 4 +
           region_bytes(job) + branch_bytes(job) + starts_bytes(job) + rigs_bytes(job) + coarse_map_bytes(job);
}

std::int64_t largest_curves_file(const job::Job& job) {
    constexpr std::int64_t all_curves = 50'000'000;  // far above any observed
    const std::int64_t of_cell = job.curves.edge_distance ? 35 : 17;
    return all_curves + job.cells() * of_cell;
}

std::string starts_price(const job::Job& job) {
    std::string text;
    if (job.starts.count > 0)
        text += fmt::format("#   starts   {}\n", each_in_words(job, job.starts.count, ""));
    const double kicks = cycles_of_kicks(job);
    if (kicks == 0) return text;
    // a cell whose kicks all return at once takes a twentieth of the mean, one with long chaotic returns ten
    // times
    const double seconds = static_cast<double>(job.cells()) * kicks * usual_cycle_time(job);
    return text + fmt::format(
                      "#   kicks    of {}: some {} of one core more, between a twentieth and ten times as "
                      "much where cells are few\n",
                      job.starts.count > 0 ? "all attractors of each cell" : "the orbit of each cell",
                      readable_duration(seconds));
}

std::string rigs_price(const job::Job& job) {
    if (job.uncertainty.rigs == 0) return "";
    const std::string again = drawn_again_in_words(job);
    return fmt::format("#   draws    {}{}\n", each_in_words(job, job.uncertainty.rigs, " rigs"),
                       again.empty() ? "" : "; " + again);
}

std::string time_price(const job::Job& job) {
    const SampledCost cost = sample_cost(job);
    const auto cells = static_cast<double>(job.cells());
    const bool is_sweep = job.kind == job::Kind::sweep;
    const double seconds = cells * cost.seconds;
    const double margin = 2 * cost.relative_error;
    std::string text =
        fmt::format("#   time     {} cycles a {}: {}{} of one core{}", readable_mean(cost.cycles),
                    is_sweep ? "point" : "cell", cost.unseen_share > 0 ? "at least " : "some ",
                    seconds < 1e-3 ? "1 ms or less" : readable_duration(seconds),
                    job.kind == job::Kind::curves ? " for the coarse map; following curves comes on top"
                    : job.refine.levels > 0       ? " if all were computed, of which refinement spares a part"
                                                  : "");
    text += margin == 0 && cost.unseen_share == 0
                ? fmt::format("; all were tried here, in {}", readable_duration(cost.spent))
                : fmt::format(", {} to {}, by {} of them solved here in {}",
                              readable_duration(seconds / (1 + margin)),
                              readable_duration(seconds * (1 + margin + cost.unseen_share)),
                              readable_count(cost.cells), readable_duration(cost.spent));
    if (cost.unseen_share > 0)
        text +=
            "; some were given up there before all the cycles that they are given (steady_state.max_cycles)";
    if (job.audit.cells > 0 && cost.integrated_cycle > 0) {
        const double audit = static_cast<double>(job.audit.cells) * cost.cycles * cost.integrated_cycle;
        text += fmt::format("; the audit's integrator takes some {} more", readable_duration(audit));
    }
    return text + "\n";
}

// On one core, as measured on the plane of the paper's rig of 170 mm: 0.1 ms for an orbit with linear springs,
// 1.4 ms with the cubic term, 0.02 and 0.08 ms for a motion without impact; the way from the start to an orbit
// 1.6 and 24 ms more; one that doubles lose, some one in a hundred there, 0.3 and 3 s in many digits.
std::string certificate_price(const job::Job& job) {
    const std::int64_t cells = std::min(job.certificate.cells, job.cells());
    if (cells == 0 || job.kind == job::Kind::curves) return "";
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    if (rig.spring_dashpot() == nullptr && !job::is_rigid(job.contact)) {
        return "#   proofs   none: there is no theorem for this law of the stop, and `certified` will say so\n";
    }
    const double orbit = rig.cubic == 0 ? 1e-4 : 1.4e-3;
    const double way = rig.cubic == 0 ? 1.6e-3 : 24e-3;
    const double seconds_per_cell = orbit + (job.certificate.starts ? way : 0);
    const auto all = static_cast<double>(cells);
    std::string text = fmt::format("#   proofs   of {} cells: {} of one core, or less\n", readable_count(cells),
                                   readable_duration(all * seconds_per_cell));
    if (job.certificate.many_digits) {
        text +=
            fmt::format("#   proofs   in many digits: some {} of one core for each start that doubles lose\n",
                        readable_duration(rig.cubic == 0 ? 0.3 : 3));
    }
    if (job.certificate.attractors) {
        text += fmt::format(
            "#   proofs   of their attractors: {} of one core for each that a cell has, {} are kept at most\n",
            readable_duration(all * orbit), job.starts.attractors);
    }
    return text;
}

std::string noise_price(const job::Job& job) {
    if (!job.noise.any()) return "";
    const SampledLives lives = sample_lives(job);
    const std::string_view place = job.kind == job::Kind::sweep ? "point" : "cell";
    const double seconds = static_cast<double>(job.cells()) * lives.seconds;
    const double margin = 2 * lives.relative_error;
    return fmt::format(
        "#   noise    lives of settled motions: some {} of one core more{}, {} to {}, by {} {}{} tried here in "
        "{}\n",
        readable_duration(seconds), job.refine.levels > 0 ? " if all cells were computed" : "",
        readable_duration(seconds / (1 + margin)), readable_duration(seconds * (1 + margin)),
        readable_count(lives.cells), place, lives.cells == 1 ? "" : "s", readable_duration(lives.spent));
}

// Processor time per place on the plane of the paper's rig of 170 mm, as measured beside many other processes:
// 8 ms at 98 gaps with linear springs (2,474 places), 0.7 s at gap 0 with the cubic term (24 places).
std::string crossings_price(const job::Job& job) {
    const std::size_t gaps = job.curves.gaps().size();
    if (job.certificate.cells == 0 || gaps == 0) return "";
    const bool is_linear = scene::Scene(job).cell(0, 0).oscillator.cubic == 0;
    const double seconds = is_linear ? 8e-3 : 0.7;
    return fmt::format("#   proofs   of each place where a curve has {}: some {} of one core\n",
                       gaps == 1 ? "the gap" : fmt::format("one of the {} gaps", gaps),
                       readable_duration(seconds));
}

// The impact rate of chaos is known only for what was computed: in one cycle of four, or more, nearly
// everywhere. So this is an upper estimate, and reported only where it is far above what the job allows.
std::string long_chaos_price(const job::Job& job) {
    constexpr double impacts = 0.25;
    constexpr std::int64_t far = 2;
    const scene::Scene scene(job);
    std::int64_t cycles = 0;
    for (const std::int64_t row : {std::int64_t{0}, scene.rows() - 1}) {
        for (const std::int64_t column : {std::int64_t{0}, scene.columns() - 1}) {
            const auto oscillator = scene.cell(row, column).oscillator;
            if (scene::is_conservative(oscillator)) {
                return "#   chaos    nothing dissipates in some cells, so that nothing settles there: they "
                       "stay unresolved, "
                       "whatever steady_state.max_cycles is\n";
            }
            cycles = std::max(cycles, regime::cycles_for_chaos(oscillator, job.steady_state, impacts));
        }
    }
    if (cycles <= far * job.steady_state.max_cycles) return "";
    const double seconds = static_cast<double>(cycles) * usual_cycle_time(job);
    return fmt::format(
        "#   chaos    takes up to some {} cycles to be told from a long transient where the rig loses least, "
        "steady_state.max_cycles are {}: cells may stay chaotic_so_far. With max_cycles = {} each of these "
        "takes "
        "up to {} of one core\n",
        readable_count(cycles), readable_count(job.steady_state.max_cycles), cycles,
        readable_duration(seconds));
}

}  // namespace peterka
