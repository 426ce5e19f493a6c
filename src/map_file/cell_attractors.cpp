#include "map_file/cell_attractors.hpp"

namespace peterka::map_file {

std::vector<quantities::StoredAttractor> stored_attractors(std::span<const attractors::SolvedCell> cells,
                                                           std::int64_t kept,
                                                           std::span<const scene::Scales> scales) {
    std::vector<quantities::StoredAttractor> stored(static_cast<std::size_t>(kept) * cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        for (std::size_t slot = 0; slot < cells[cell].attractors.size(); ++slot) {
            stored[slot * cells.size() + cell] =
                quantities::in_file_units(cells[cell].attractors[slot], scales[cell]);
        }
    }
    return stored;
}

}  // namespace peterka::map_file
