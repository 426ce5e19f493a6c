#include "regime/search_outcome.hpp"

namespace peterka::regime {

Task<SearchOutcome> outcome_of(Task<CellResult> search) {
    SearchOutcome outcome;
    outcome.result = co_await search;
    outcome.cycles = outcome.result.cycles;
    co_return outcome;
}

}  // namespace peterka::regime
