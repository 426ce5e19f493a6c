#include "attractors/kicks.hpp"

#include "attractors/kick_scan.hpp"
#include "attractors/kicked_orbit.hpp"
#include "attractors/safe_kicks.hpp"
#include "attractors/side_by_side.hpp"
#include "regime/same_attractor.hpp"

namespace peterka::attractors {

namespace {

// A failed search yields no information.
KickScan::Outcome outcome_of(const regime::CellResult& settled, const regime::CellResult& ended) {
    using enum regime::Regime;
    KickScan::Outcome outcome{.cycles = ended.cycles};
    if (ended.forgot_after > 0) outcome.chaotic = ended.followed_cycles - ended.forgot_after;
    if (ended.regime == failed || regime::same_attractor(settled, ended)) return outcome;
    const bool is_chaos = ended.regime == chaotic || (ended.regime == unresolved && outcome.chaotic > 0);
    outcome.end = is_chaos ? KickScan::Outcome::End::chaos : KickScan::Outcome::End::elsewhere;
    return outcome;
}

// What became of kicks that were tried together. The engine may not carry one of them to the next phase 0,
// which yields no information either.
Task<std::vector<KickScan::Outcome>> outcomes_of(SearchBroker& broker, const KickedCell& cell,
                                                 const regime::CellResult& settled, KickedOrbit& orbit,
                                                 std::vector<KickTried> kicks) {
    std::vector<SearchFactory> searches;
    std::vector<std::size_t> searched;
    for (std::size_t i = 0; i < kicks.size(); ++i) {
        const auto start = orbit.after(kicks[i]);
        if (!start) continue;
        searches.push_back(cell.search_from(*start));
        searched.push_back(i);
    }
    const std::vector<SearchOutcome> ended = co_await broker.searches(std::move(searches));
    std::vector<KickScan::Outcome> outcomes(kicks.size());
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
    kick.tried = scan.tried();
    const auto safe = largest_safe_kick(orbit, cell.known, cell.oscillator, *attractor.orbit, kick.tried);
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
