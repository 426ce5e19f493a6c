// Adds to the slots of a finished map with [starts] the motions known to exist in its cells although none of
// their starts found them (attractors/known_motions.hpp, map_file/known_slots.hpp).
#pragma once

#include "map_file/map_file.hpp"
#include "parallel/session.hpp"
#include "parallel/tile_set.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Collective, once all tiles are done; does nothing to files of other jobs. If a run is stopped during it,
// repeating it gives the same result.
void add_known_motions(const parallel::Session& session, const scene::Scene& scene, map_file::MapFile& file);

// Collective. Adds the tiles in which a stopped run discarded slots.
void add_tiles_to_tell_again(const parallel::Session& session, const job::Job& job,
                             const map_file::MapFile& file, parallel::TileSet& missing);

}  // namespace peterka
