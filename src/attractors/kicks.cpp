#include "attractors/kicks.hpp"

#include "attractors/kick_scan.hpp"
#include "attractors/kicked_orbit.hpp"
#include "attractors/safe_kicks.hpp"
#include "attractors/side_by_side.hpp"
#include "regime/same_attractor.hpp"

namespace peterka::attractors {

namespace {

using End = KickScan::Outcome::End;

KickScan::Outcome outcome_of(const regime::CellResult& settled, const regime::CellResult& ended) {
    using enum regime::Regime;
    KickScan::Outcome outcome{.cycles = ended.cycles};
    if (ended.forgot_after > 0) outcome.chaotic = ended.followed_cycles - ended.forgot_after;
    if (ended.regime == failed) {
        outcome.end = ended.status == cell::Status::not_finite ? End::elsewhere : End::unknown;
        return outcome;
    }
    if (regime::same_attractor(settled, ended)) return outcome;
    if (ended.regime == unresolved && outcome.chaotic == 0) {
        outcome.end = End::unknown;  // the budget ran out on a way that may lead back
        return outcome;
    }
    outcome.end = ended.regime == chaotic || ended.regime == unresolved ? End::chaos : End::elsewhere;
    return outcome;
}

// What became of kicks that were tried together. A softening spring may throw the hammer out, to where no
// motion returns from, even before the next phase 0.
Task<std::vector<KickScan::Outcome>> outcomes_of(SearchBroker& broker, const KickedCell& cell,
                                                 const regime::CellResult& settled, KickedOrbit& orbit,
                                                 std::vector<KickTried> kicks) {
    std::vector<SearchFactory> searches;
    std::vector<std::size_t> searched;
    std::vector<KickScan::Outcome> outcomes(kicks.size());
    for (std::size_t i = 0; i < kicks.size(); ++i) {
        const KickedOrbit::Carried start = orbit.after(kicks[i]);
        if (!start.done()) {
            const bool escapes = start.outcome == trajectory::Cycle<double>::Outcome::not_finite;
            outcomes[i] = {.end = escapes ? End::elsewhere : End::unknown, .cycles = 1};
            continue;
        }
        searches.push_back(cell.search_from(start.state));
        searched.push_back(i);
    }
    const std::vector<SearchOutcome> ended = co_await broker.searches(std::move(searches));
    for (std::size_t i = 0; i < ended.size(); ++i) outcomes[searched[i]] = outcome_of(settled, ended[i].result);
    co_return outcomes;
}

Task<cell::Kick> smallest_kick(SearchBroker& broker, const KickedCell& cell, const Tally::Entry& attractor) {
    cell::Kick kick;
    if (!attractor.orbit) co_return kick;
    KickedOrbit orbit(cell.oscillator, *attractor.orbit);
    KickScan scan(orbit.period(), cell.largest);
    for (auto kicks = scan.next({}); !kicks.empty();) {
        kicks = scan.next(co_await outcomes_of(broker, cell, attractor.result, orbit, std::move(kicks)));
    }
    kick.tried = scan.known();
    const auto safe = largest_safe_kick(orbit, cell.known, cell.oscillator, *attractor.orbit, scan.tried());
    if (safe) kick.lower = *safe;
    if (!scan.found()) co_return kick;
    kick.size = scan.smallest().size();
    kick.phase = scan.smallest().phase;
    kick.direction = scan.smallest().change < 0 ? -1 : 1;
    co_return kick;
}

}  // namespace

Task<std::vector<cell::Kick>> smallest_kicks(SearchBroker& broker, const KickedCell& cell,
                                             std::span<const Tally::Entry> attractors) {
    return side_by_side<cell::Kick>(broker, attractors.size(),
                                    [&cell, attractors](std::size_t slot, SearchBroker& own) {
                                        return smallest_kick(own, cell, attractors[slot]);
                                    });
}

}  // namespace peterka::attractors
