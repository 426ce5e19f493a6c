#include "run/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "attractors/along_branch.hpp"
#include "job/branches.hpp"
#include "job/stored_quantities.hpp"
#include "map_file/layout.hpp"
#include "map_file/samples.hpp"
#include "refine/region.hpp"
#include "refine/regions.hpp"
#include "regime/branch.hpp"
#include "regime/cycles_for_chaos.hpp"
#include "regime/engine.hpp"
#include "report/outcomes_summary.hpp"
#include "run/memory_left.hpp"
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

// Forcing cycles of a cell with [starts], as counted on the window of the paper's rig of 170 mm (24 x 24 cells:
// 57 per start with 64 starts; 12 x 12 cells: 78 with 16): about a dozen starts run in full, later ones end on
// the attractors these found.
double cycles_of_starts(const job::Job& job) {
    const auto count = static_cast<double>(job.starts.count);
    return 47 * count + 50 * std::min(count, 12.0);
}

// Forcing cycles of the rigs drawn for a cell, as counted on the same window (32 x 32 cells, 64 rigs): each
// runs in full, from [start], which hardly moves most of them, or from a start of its own.
double cycles_of_rigs(const job::Job& job) {
    return static_cast<double>(job.uncertainty.rigs) * (job.starts.count > 0 ? 86 : 35);
}

// Cost of kicks on the plane of the paper's rig of 170 mm (16 x 16 cells, 16 starts), in cycles of the batch:
// 850,000 for all attractors of a cell, mostly for long chaotic returns; and 34,000 for its own motion, each at
// twice the time, as the kicks of one orbit fill the lanes less evenly.
double cycles_of_kicks(const job::Job& job) {
    if (!job.output.has(job::OptionalField::critical_kick)) return 0;
    return job.starts.count > 0 ? 850'000 : 68'000;
}

// Time of such a cycle, with everything it entails, on one core with AVX-512, as measured (with AVX2 the first
// takes 1.5 times as long): in the batch, on a rigid or a yielding stop; in the batch with the cubic spring
// kept, whose many kicks depend on the reach; one by one; by integrators, 130 to 320 on the stops tried.
double microseconds_of_a_cycle(const job::Job& job) {
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    const job::EngineChoice engine = job.solver.engine;
    const bool integrates = engine == job::EngineChoice::cvode || engine == job::EngineChoice::arkode ||
                            regime::has_nonlinear_contact(rig);
    if (integrates) return 200;
    if (!regime::may_use_batch(rig, job.solver)) return 1.3;
    const bool keeps_cubic =
        rig.cubic != 0 && (engine == job::EngineChoice::split || job.solver.omit_tolerance == 0);
    return keeps_cubic ? 2.6 : 0.33;
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

// A cell whose starts settle at once takes a twentieth of the mean, a chaotic one ten times the mean: for few
// cells the mean says little.
std::string starts_price(const job::Job& job) {
    const bool kicks = job.output.has(job::OptionalField::critical_kick);
    if (job.starts.count == 0 && !kicks) return "";
    constexpr double enough = 100;
    const bool is_sweep = job.kind == job::Kind::sweep;
    const auto shared = static_cast<double>(is_sweep ? job::branches_of_a_gap(job.sweep) : 1);
    const double cells = static_cast<double>(job.cells()) / shared;
    const double starts = static_cast<double>(job.starts.count) * cells;
    const double seconds =
        cells * (cycles_of_starts(job) + cycles_of_kicks(job)) * microseconds_of_a_cycle(job) * 1e-6;
    const std::string words =
        cells < enough
            ? fmt::format("from {} to {} of one core: few cells may all settle at once, or all be chaotic",
                          readable_duration(seconds / 20), readable_duration(seconds * 10))
            : fmt::format("some {} of one core, about", readable_duration(seconds));
    if (job.starts.count == 0) return fmt::format("#   kicks    of the orbit of each cell: {}\n", words);
    return fmt::format("#   starts   {} in each {}, {:.3g} in all{}: {}\n", readable_count(job.starts.count),
                       is_sweep ? "point" : "cell", starts, kicks ? ", and critical kicks" : "", words);
}

std::string rigs_price(const job::Job& job) {
    if (job.uncertainty.rigs == 0) return "";
    constexpr double own_rig = 1.2;  // a cycle where each has its own
    const bool is_sweep = job.kind == job::Kind::sweep;
    const auto shared = static_cast<double>(is_sweep ? job::branches_of_a_gap(job.sweep) : 1);
    const double cells = static_cast<double>(job.cells()) / shared;
    const double seconds = cells * cycles_of_rigs(job) * own_rig * microseconds_of_a_cycle(job) * 1e-6;
    const std::string again = drawn_again_in_words(job);
    return fmt::format("#   draws    {} rigs in each {}, {:.3g} in all: some {} of one core, about{}\n",
                       readable_count(job.uncertainty.rigs), is_sweep ? "point" : "cell",
                       static_cast<double>(job.uncertainty.rigs) * cells, readable_duration(seconds),
                       again.empty() ? "" : "; " + again);
}

// On one core, as measured on the plane of the paper's rig of 170 mm: 0.1 ms for an orbit with linear springs,
// 1.4 ms with the cubic term, 0.02 and 0.08 ms for a motion without impact; the way from the start to an orbit
// 1.6 and 24 ms more.
std::string certificate_price(const job::Job& job) {
    const std::int64_t cells = std::min(job.certificate.cells, job.cells());
    if (cells == 0) return "";
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    if (rig.spring_dashpot() == nullptr && !job::is_rigid(job.contact)) {
        return "#   proofs   none: there is no theorem for this law of the stop, and `certified` will say so\n";
    }
    const double orbit = rig.cubic == 0 ? 1e-4 : 1.4e-3;
    const double way = rig.cubic == 0 ? 1.6e-3 : 24e-3;
    const double seconds_per_cell = orbit + (job.certificate.starts ? way : 0);
    return fmt::format("#   proofs   of {} cells: {} of one core, or less\n", readable_count(cells),
                       readable_duration(static_cast<double>(cells) * seconds_per_cell));
}

// On one core, as measured on the plane of the paper's rig of 170 mm, a third of whose cells have an orbit:
// 0.05 ms for each cell with linear springs, 1 ms with the cubic term.
std::string elasticities_price(const job::Job& job) {
    const auto requested = std::ranges::count_if(
        job::stored_quantities(job),
        [](const cell::Quantity* quantity) { return quantity->keeping.by_number != nullptr; });
    if (requested == 0) return "";
    const double seconds_per_cell = scene::Scene(job).cell(0, 0).oscillator.cubic == 0 ? 1e-4 : 1.5e-3;
    return fmt::format("#   numbers  {} elasticities of the orbit of each cell: {} of one core, or less\n",
                       requested, readable_duration(static_cast<double>(job.cells()) * seconds_per_cell));
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
            cycles = std::max(cycles, regime::cycles_for_chaos(scene.cell(row, column).oscillator,
                                                               job.steady_state, impacts));
        }
    }
    if (cycles <= far * job.steady_state.max_cycles) return "";
    const double seconds = static_cast<double>(cycles) * microseconds_of_a_cycle(job) * 1e-6;
    return fmt::format(
        "#   chaos    takes up to some {} cycles to be told from a long transient where the rig loses least, "
        "steady_state.max_cycles are {}: cells may stay chaotic_so_far. With max_cycles = {} each of these "
        "takes "
        "up to {} of one core\n",
        readable_count(cycles), readable_count(job.steady_state.max_cycles), cycles,
        readable_duration(seconds));
}

}  // namespace peterka
