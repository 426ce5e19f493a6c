#include "attractors/tally.hpp"

#include <algorithm>
#include <tuple>

#include "regime/same_attractor.hpp"

namespace peterka::attractors {

namespace {

auto order_of(const Tally::Entry& entry) {
    const regime::CellResult& result = entry.result;
    // NaN, in failed results, has no order; they form a single entry
    return std::tuple(-entry.starts, result.regime, result.period, result.impacts, result.peak_force,
                      result.orbit_displacement, result.orbit_velocity);
}

std::optional<regime::FoundAttractor> orbit_of(const regime::CellResult& result,
                                               std::span<const regime::FoundAttractor> found) {
    if (result.regime != regime::Regime::periodic) return std::nullopt;
    for (const regime::FoundAttractor& each : found) {
        if (each.settings.engine == result.engine && regime::same_orbit(each.result, result)) return each;
    }
    return std::nullopt;
}

// An imprecise force at least belongs to this attractor, whereas a start decided by rounding may not.
bool leaves_less_open(regime::Status one, regime::Status other) {
    using enum regime::Status;
    return other == rounding ? one == verified || one == imprecise : other == imprecise && one == verified;
}

}  // namespace

Tally::Entry Tally::entry_of(const regime::CellResult& result, std::span<const regime::FoundAttractor> found) {
    return {.result = result, .orbit = orbit_of(result, found), .starts = 0, .first = no_start};
}

void Tally::add(const regime::CellResult& result, std::span<const regime::FoundAttractor> found) {
    const std::int32_t known = slot_of(entries_, result);
    if (known >= 0) {
        Entry& entry = entries_[static_cast<std::size_t>(known)];
        ++entry.starts;
        if (leaves_less_open(result.status, entry.result.status)) entry.result.status = result.status;
    } else {
        entries_.push_back({result, orbit_of(result, found), 1, added_});
    }
    ++added_;
}

std::vector<Tally::Entry> Tally::in_order() const {
    std::vector<Entry> ordered = entries_;
    std::ranges::stable_sort(ordered, [](const Entry& a, const Entry& b) { return order_of(a) < order_of(b); });
    return ordered;
}

std::int32_t slot_of(std::span<const Tally::Entry> entries, const regime::CellResult& result) {
    const auto entry = std::ranges::find_if(
        entries, [&](const Tally::Entry& each) { return regime::same_attractor(each.result, result); });
    return entry == entries.end() ? -1 : static_cast<std::int32_t>(entry - entries.begin());
}

void keep_most(std::vector<Tally::Entry>& ordered, const Tally::Entry& own, std::size_t most) {
    const std::int32_t found = slot_of(ordered, own.result);
    std::vector<Tally::Entry> last;
    if (found >= static_cast<std::int32_t>(most)) last.push_back(ordered[static_cast<std::size_t>(found)]);
    if (found < 0 && cell::is_motion(own.result.regime)) last.push_back(own);
    if (most == 1) last.clear();  // the largest share takes precedence
    ordered.resize(std::min(ordered.size(), most - last.size()));
    ordered.insert(ordered.end(), last.begin(), last.end());
}

CellAttractor as_attractor(const Tally::Entry& entry, std::int64_t all_starts) {
    CellAttractor attractor = without_share(entry.result);
    attractor.share = static_cast<double>(entry.starts) / static_cast<double>(all_starts);
    return attractor;
}

CellAttractor without_share(const regime::CellResult& result) {
    return {.regime = result.regime,
            .status = result.status,
            .impacts = result.impacts,
            .period = result.period,
            .peak_force = result.peak_force,
            .orbit_displacement = result.orbit_displacement,
            .orbit_velocity = result.orbit_velocity,
            .certified = cell::Certified::not_tried};
}

}  // namespace peterka::attractors
