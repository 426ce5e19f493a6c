// Statistics of the outcomes of the rigs drawn for a map's cells. Sums, independent of the grouping of cells.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "findings/start_findings.hpp"
#include "quantities/fields.hpp"

namespace peterka::findings {

// From this probability on, an outcome is called likely.
inline constexpr double likely = 0.95;

struct OutcomeCounts {
    std::int64_t cells = 0;
    std::int64_t open = 0;       // cells without a likely outcome
    std::int64_t other_own = 0;  // cells whose own rig ends otherwise than most of those drawn
    std::int64_t left_over = 0;  // cells with more outcomes than are stored

    void add(const OutcomeCounts& other);
};

struct OutcomeFindings {
    OutcomeCounts counts;
    std::map<AttractorLabel, std::int64_t> by_likely;  // cells in which the outcome is likely
};

// Adds the cells of a tile; outcomes are given slot by slot, equally many for each cell. Cells not yet computed
// are skipped.
void add_outcomes(OutcomeFindings& findings, std::span<const quantities::StoredCell> cells,
                  std::span<const quantities::StoredOutcome> outcomes);

}  // namespace peterka::findings
