// What a finished map with [starts] knows to exist in its cells though none of their starts found it, added to
// their slots (attractors/known_motions.hpp, map_file/known_slots.hpp).
#pragma once

#include "map_file/map_file.hpp"
#include "parallel/session.hpp"
#include "parallel/tile_set.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Collective, once all tiles are done; does nothing to files of other jobs. The same once more after a run that
// was stopped in it.
void add_known_motions(const parallel::Session& session, const scene::Scene& scene, map_file::MapFile& file);

// Collective. Adds the tiles in which a run that was stopped let slots give way.
void add_tiles_to_tell_again(const parallel::Session& session, const job::Job& job,
                             const map_file::MapFile& file, parallel::TileSet& missing);

}  // namespace peterka
