// Statistics of a map file over all ranks, each of which reads a share of the tiles. Collective.
#pragma once

#include <mpi.h>

#include "output/statistics.hpp"
#include "output/tile_store.hpp"

namespace peterka::output {

[[nodiscard]] Statistics survey(const TileStore& tiles, MPI_Comm communicator);

}  // namespace peterka::output
