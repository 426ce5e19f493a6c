#include "attractors/kicks.hpp"

#include <utility>

#include "attractors/safe_kicks.hpp"
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

}  // namespace

Kicks::Kicks(const scene::Oscillator<double>& cell, std::span<const Tally::Entry> attractors, double largest,
             const regime::AttractorTable& known, SearchFrom search_from)
    : cell_(cell), known_(known), search_from_(std::move(search_from)) {
    for (std::size_t slot = 0; slot < attractors.size(); ++slot) {
        const Tally::Entry& entry = attractors[slot];
        if (!entry.orbit) continue;
        KickedOrbit orbit(cell, *entry.orbit);
        const KickScan scan(orbit.period(), largest);
        kicked_.push_back({slot, entry.result, *entry.orbit, std::move(orbit), scan});
    }
}

std::vector<SearchFactory> Kicks::next(std::span<const SearchOutcome> ended) {
    std::vector<SearchFactory> searches;
    bool goes_on = true;
    while (searches.empty() && goes_on) {  // the engine may carry none of these kicks
        goes_on = false;
        for (Kicked& kicked : kicked_) goes_on |= kick(kicked, ended, searches);
    }
    return searches;
}

// The next kicks of one motion, once its previous ones have ended; false when there are none.
bool Kicks::kick(Kicked& kicked, std::span<const SearchOutcome>& ended, std::vector<SearchFactory>& searches) {
    const std::vector<KickTried> kicks = kicked.scan.next(take(kicked, ended));
    kicked.carried.clear();
    for (const KickTried& each : kicks) {
        const auto start = kicked.orbit.after(each);
        kicked.carried.push_back(start.has_value());
        if (start) searches.push_back(search_from_(*start));
    }
    return !kicks.empty();
}

// The outcomes of its last kicks; advances `ended` past them.
std::vector<KickScan::Outcome> Kicks::take(const Kicked& kicked, std::span<const SearchOutcome>& ended) {
    std::vector<KickScan::Outcome> outcomes;
    for (const bool carried : kicked.carried) {
        if (!carried) {
            outcomes.push_back({});
            continue;
        }
        const regime::CellResult& result = ended.front().result;
        outcomes.push_back(outcome_of(kicked.result, result));
        ended = ended.subspan(1);
    }
    return outcomes;
}

cell::Kick Kicks::smallest(std::size_t slot) {
    cell::Kick kick;
    for (Kicked& kicked : kicked_) {
        if (kicked.slot != slot) continue;
        kick.tried = kicked.scan.tried();
        const auto safe = largest_safe_kick(kicked.orbit, known_, cell_, kicked.found, kick.tried);
        if (safe) kick.lower = *safe;
        if (!kicked.scan.found()) break;
        const KickTried& smallest = kicked.scan.smallest();
        kick.size = smallest.size();
        kick.phase = smallest.phase;
        kick.direction = smallest.change < 0 ? -1 : 1;
    }
    return kick;
}

}  // namespace peterka::attractors
