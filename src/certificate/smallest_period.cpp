#include "certificate/smallest_period.hpp"

namespace peterka::certificate {
namespace {

bool is_prime(std::int64_t n) {
    for (std::int64_t d = 2; d * d <= n; ++d) {
        if (n % d == 0) return false;
    }
    return n > 1;
}

// Whether the orbit surely differs from itself period/parts cycles later: a shorter period would map its events
// onto one another, in order.
bool differs_after(const EventChain& chain, const std::vector<Place<Interval>>& places, std::int64_t parts) {
    const std::size_t events = places.size();
    if (events % static_cast<std::size_t>(parts) != 0) return true;
    const std::size_t shift = events / static_cast<std::size_t>(parts);
    for (std::size_t i = 0; i + shift < events; ++i) {
        const std::size_t j = i + shift;
        const bool other_cycle = chain.events[j].cycle - chain.events[i].cycle != chain.period / parts;
        const bool differs = chain.events[i].kind != chain.events[j].kind ||
                             places[i].along.apart(places[j].along) ||
                             (!other_cycle && places[i].time.apart(places[j].time));
        if (differs) return true;
    }
    return false;
}

}  // namespace

bool has_no_smaller_period(const EventChain& chain, const std::vector<Place<Interval>>& places) {
    for (std::int64_t parts = 2; parts <= chain.period; ++parts) {
        const bool may_be = chain.period % parts == 0 && is_prime(parts);
        if (may_be && !differs_after(chain, places, parts)) return false;
    }
    return true;
}

}  // namespace peterka::certificate
