// Statistics of a map file over all ranks, each of which reads a share of the tiles. Collective.
#pragma once

#include <mpi.h>

#include "findings/statistics.hpp"
#include "map_file/tile_store.hpp"

namespace peterka::map_file {

[[nodiscard]] findings::Statistics survey(const TileStore& tiles, const job::Job& job, MPI_Comm communicator);

}  // namespace peterka::map_file
