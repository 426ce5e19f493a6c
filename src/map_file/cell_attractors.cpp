#include "map_file/cell_attractors.hpp"

namespace peterka::map_file {

namespace {

// The first slot of all cells, then the second, ...
template <class Slot, class SlotsOf>
std::vector<Slot> slot_by_slot(std::span<const attractors::SolvedCell> cells, std::int64_t kept,
                               std::span<const scene::Scales> scales, SlotsOf slots_of) {
    std::vector<Slot> stored(static_cast<std::size_t>(kept) * cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const auto& slots = slots_of(cells[cell]);
        for (std::size_t slot = 0; slot < slots.size(); ++slot) {
            stored[slot * cells.size() + cell] = quantities::in_file_units(slots[slot], scales[cell]);
        }
    }
    return stored;
}

}  // namespace

std::vector<quantities::StoredAttractor> stored_attractors(std::span<const attractors::SolvedCell> cells,
                                                           std::int64_t kept,
                                                           std::span<const scene::Scales> scales) {
    return slot_by_slot<quantities::StoredAttractor>(
        cells, kept, scales, [](const attractors::SolvedCell& cell) -> const auto& { return cell.attractors; });
}

std::vector<quantities::StoredOutcome> stored_outcomes(std::span<const attractors::SolvedCell> cells,
                                                       std::span<const scene::Scales> scales) {
    return slot_by_slot<quantities::StoredOutcome>(
        cells, cell::kept_outcomes, scales,
        [](const attractors::SolvedCell& cell) -> const auto& { return cell.outcomes; });
}

}  // namespace peterka::map_file
