// Finds the attractors of a finished basin and numbers every cell's. Collective.
//
// Uses the stored cells alone, so that a resumed run needs nothing else, and works tile by tile, so that the
// memory stays small. The first cell of the whole basin that no known attractor explains becomes the next
// attractor, until none is left or the table is full: the result does not depend on which rank reads which
// tile.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "findings/attractors.hpp"
#include "hdf5/stored.hpp"
#include "map_file/tile_store.hpp"

namespace peterka::map_file {

// Writes the dataset /attractor and the group /attractors. Returns how many cells have an attractor for which
// the table had no row left.
std::int64_t number_attractors(const hdf5::OpenMap& map, const TileStore& tiles, MPI_Comm communicator);

// The table of a basin whose cells have been numbered. Independent.
[[nodiscard]] std::vector<findings::Attractor> read_attractor_table(const hdf5::OpenMap& map);

}  // namespace peterka::map_file
