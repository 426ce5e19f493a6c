#include "findings/outcome_findings.hpp"

#include <cstddef>

namespace peterka::findings {

void OutcomeCounts::add(const OutcomeCounts& other) {
    cells += other.cells;
    open += other.open;
    other_own += other.other_own;
    left_over += other.left_over;
}

void add_outcomes(OutcomeFindings& findings, std::span<const quantities::StoredCell> cells,
                  std::span<const quantities::StoredOutcome> outcomes) {
    if (outcomes.empty()) return;
    OutcomeCounts& counts = findings.counts;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const quantities::StoredCell& cell = cells[i];
        if (static_cast<std::int8_t>(cell.regime) == regime::regime_not_computed) continue;
        const quantities::StoredOutcome& first = outcomes[i];  // the most likely one
        ++counts.cells;
        const bool is_own =
            first.regime == cell.regime && (cell.regime != regime::Regime::periodic ||
                                            (first.impacts == cell.impacts && first.period == cell.period));
        counts.other_own += is_own ? 0 : 1;
        counts.left_over += cell.outcome_others > 0 ? 1 : 0;
        if (first.probability < likely) {
            ++counts.open;
        } else {
            ++findings.by_likely[{first.regime, first.period, first.impacts}];
        }
    }
}

}  // namespace peterka::findings
