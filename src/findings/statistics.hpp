// Counts and extremes over all cells present in a map, for its closing summary.
//
// The result is independent of the grouping and merging of cells: counts are sums, and of equal extremes the
// one with the lowest cell wins. Forces are relative to the hammer's weight, F/(m g0).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "findings/elasticity_findings.hpp"
#include "findings/outcome_findings.hpp"
#include "findings/proof_findings.hpp"
#include "findings/start_findings.hpp"
#include "findings/transients.hpp"
#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"

namespace peterka::findings {

// The largest peak force of a set of cells, and where it occurs.
struct LargestForce {
    double peak_force_ratio = -std::numeric_limits<double>::infinity();
    std::int64_t row = -1;
    std::int64_t column = -1;
    double mass = 1;  // of the hammer, in one unit for all cells
    // a cell::Regime, as wide as the rest: ranks exchange these bytes
    std::int64_t regime = static_cast<std::int64_t>(cell::Regime::unresolved);

    [[nodiscard]] bool found() const { return row >= 0; }
    [[nodiscard]] double force() const { return peak_force_ratio * mass; }  // by which it is the largest
    void take(const LargestForce& other);
};

// z = p/q; ordered by q, then p.
struct ImpactClass {
    std::int32_t period = 0;
    std::int32_t impacts = 0;
    friend auto operator<=>(const ImpactClass&, const ImpactClass&) = default;
};

struct Counts {
    std::array<std::int64_t, cell::regime_names.size()> by_regime{};
    std::array<std::int64_t, cell::status_names.size()> unresolved_by_status{};
    std::array<std::int64_t, cell::status_names.size()> failed_by_status{};
    std::array<std::int64_t, cell::status_names.size()> open_by_status{};  // cases that proofs leave open
    std::array<std::int64_t, cell::engine_names.size()> by_engine{};
    std::int64_t cells = 0;   // in the map so far
    std::int64_t filled = 0;  // of these, filled from neighbouring cells
    std::int64_t cycles = 0;  // forcing cycles spent on them

    void add(const Counts& other);
};

struct Extremes {
    LargestForce any_regime;
    LargestForce one_to_one;  // z = 1/1

    void take(const Extremes& other);
};

// The numbers of cycles over which chaotic motions were followed.
struct Observed {
    std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
    std::int64_t most = 0;

    void take(const Observed& other);
};

// The chaotic_so_far cell with the fewest impacts per cycle, which dissipates least.
struct LongestChaos {
    double impact_rate = std::numeric_limits<double>::infinity();
    std::int64_t row = -1;
    std::int64_t column = -1;

    [[nodiscard]] bool found() const { return row >= 0; }
    void take(const LongestChaos& other);
};

struct Statistics {
    Counts counts;
    ProofFindings proofs;  // of the cells themselves; those of their attractors are among the starts'
    Observed chaos;
    LongestChaos longest;
    Extremes largest;
    std::map<ImpactClass, std::int64_t> periodic_cells;  // per class
    Transients transients;                               // of cells that store their last impact
    StartFindings starts;                                // of a map with [starts]
    OutcomeFindings outcomes;                            // of a map with [uncertainty]
    ElasticityFindings elasticities;                     // of a map that has some
    double tile_seconds = 0;                             // computing time of all tiles of the file [s]

    [[nodiscard]] std::int64_t cells_of(regime::Regime regime) const {
        return counts.by_regime[static_cast<std::size_t>(regime)];
    }
};

// Adds the cells of one tile, row by row; cells not yet computed are skipped. masses: of each cell's hammer, in
// any unit, if they differ.
void add_tile(Statistics& statistics, const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
              std::span<const double> masses = {});

// One line per reason why cells have no result, e.g. "3 cells failed: not_finite"; "" if all have one.
[[nodiscard]] std::string failure_text(const Counts& counts);

}  // namespace peterka::findings
