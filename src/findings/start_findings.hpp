// Statistics of the attractors of a map's cells, with many starts per cell. Sums, independent of the grouping
// of cells.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <tuple>

#include "findings/kick_counts.hpp"
#include "findings/life_findings.hpp"
#include "findings/proof_findings.hpp"
#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"

namespace peterka::findings {

// The transient chaos with the shortest mean life.
struct ShortestLife {
    double seconds = std::numeric_limits<double>::infinity();
    double error = 0;
    std::int64_t row = -1;
    std::int64_t column = -1;

    [[nodiscard]] bool found() const { return row >= 0; }
    void take(const ShortestLife& other) {
        if (std::tie(other.seconds, other.row, other.column) < std::tie(seconds, row, column)) *this = other;
    }
};

struct StartCounts {
    static constexpr std::size_t told_apart = 8;  // numbers of attractors counted; the last: or more
    std::array<std::int64_t, told_apart + 1>
        by_number{};  // cells by their number of attractors, unresolved ones not counted
    std::int64_t cells = 0;
    std::int64_t mixed = 0;       // cells with motions both with and without impacts
    std::int64_t never_hit = 0;   // cells whose known motions are all resolved, and without impacts
    std::int64_t known_free = 0;  // cells with a known motion without impacts that no start reached
    std::int64_t known_hit = 0;   // the same with impacts
    std::int64_t minority = 0;    // cells in which [start] ends on another attractor than most starts
    std::int64_t not_kept = 0;    // of these, those in which it ends on no stored one
    std::int64_t left_over = 0;   // cells with more attractors than are stored
    std::int64_t failing = 0;     // cells in which starts fail
    double most_failing = 0;      // the largest share of a cell's starts that do
    std::int64_t dying = 0;       // cells with chaos from which starts were seen to escape
    ShortestLife shortest;
    KickCounts kicks;      // also without [starts]
    ProofFindings proofs;  // of the attractors
    LifeFindings lives;    // under [noise], also without [starts]

    void add(const StartCounts& other);
};

struct AttractorLabel {
    regime::Regime regime = regime::Regime::failed;
    std::int32_t period = 0;
    std::int32_t impacts = 0;
    friend auto operator<=>(const AttractorLabel&, const AttractorLabel&) = default;
};

// The two attractors with the largest shares, by label.
struct AttractorPair {
    AttractorLabel lower;
    AttractorLabel upper;
    friend auto operator<=>(const AttractorPair&, const AttractorPair&) = default;
};

struct StartFindings {
    StartCounts counts;
    std::map<AttractorPair, std::int64_t> pairs;  // cells
};

// Whether a slot holds an attractor, not starts about which nothing is claimed.
[[nodiscard]] bool is_resolved(const quantities::StoredAttractor& attractor);

// Adds the cells of a tile; attractors are given slot by slot, equally many for each cell. Cells not yet
// computed are skipped.
void add_attractors(StartFindings& findings, const parallel::Tile& tile,
                    std::span<const quantities::StoredCell> cells,
                    std::span<const quantities::StoredAttractor> attractors);

}  // namespace peterka::findings
