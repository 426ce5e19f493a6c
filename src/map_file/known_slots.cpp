#include "map_file/known_slots.hpp"

#include <algorithm>
#include <cstddef>

namespace peterka::map_file {

namespace {

std::int64_t with_share(const Slots& slots) {
    return std::ranges::count_if(slots, [](const auto& slot) { return slot.share > 0; });
}

bool knows_start(const quantities::StoredCell& cell, const Slots& slots) {
    return cell.start_attractor >= 0 && cell.start_attractor < std::ssize(slots);
}

bool start_is_alone(const quantities::StoredCell& cell, const Slots& slots) {
    return knows_start(cell, slots) && !(slots[static_cast<std::size_t>(cell.start_attractor)].share > 0);
}

}  // namespace

// If the slot of [start] has no share, it is the first one without.
Slots own_slots(const quantities::StoredCell& cell, Slots slots) {
    const std::int64_t own = with_share(slots) + (start_is_alone(cell, slots) ? 1 : 0);
    slots.resize(static_cast<std::size_t>(own));
    return slots;
}

bool lost_slots(const quantities::StoredCell& cell, const Slots& slots, std::int64_t kept) {
    const std::int64_t room = kept - (start_is_alone(cell, slots) ? 1 : 0);
    return with_share(slots) < std::min<std::int64_t>(cell.attractors, room);
}

void add_known(quantities::StoredCell& cell, Slots& slots, std::span<const quantities::StoredAttractor> known,
               std::int64_t kept) {
    const std::int64_t shares = with_share(slots);
    if (cell.attractors > shares) return;  // a motion could be one of those that had no room
    slots.insert(slots.end(), known.begin(), known.end());
    // the smallest shares give way, but neither the largest nor that of [start], which is known, too
    for (std::int64_t slot = shares - 1; slot > 0 && std::ssize(slots) > kept; --slot) {
        if (slot == cell.start_attractor) continue;
        slots.erase(slots.begin() + slot);
        if (slot < cell.start_attractor) --cell.start_attractor;
    }
    slots.resize(static_cast<std::size_t>(std::min<std::int64_t>(std::ssize(slots), kept)));
}

}  // namespace peterka::map_file
