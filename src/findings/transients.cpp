#include "findings/transients.hpp"

#include <algorithm>
#include <functional>

namespace peterka::findings {

void Transients::add(const Transients& other) {
    cells += other.cells;
    ended += other.ended;
    cycles += other.cycles;
    longest = std::max(longest, other.longest);
    std::ranges::transform(impacting, other.impacting, impacting.begin(), std::plus<>());
}

void Transients::add(const quantities::StoredCell& cell) {
    using enum regime::Regime;
    if (!cell.computed || cell.regime == unresolved || cell.regime == failed) return;
    ++cells;
    const bool for_ever = cell.regime == periodic || cell.regime == chaotic;
    const std::int64_t last = cell.last_impact;
    for (std::size_t look = 0; look < looks.size(); ++look) {
        impacting[look] += for_ever || last > looks[look] ? 1 : 0;
    }
    if (cell.regime != no_impact || last <= 0) return;
    ++ended;
    cycles += last;
    longest = std::max(longest, last);
}

}  // namespace peterka::findings
