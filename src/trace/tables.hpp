// A trace as the datasets of its file.
//
// At the root the motion over `time`; in /impacts the list of impacts; in /impact a close view of the hardest
// one, over a time of its own, and in /impact_spectrum its spectra; in /spectrum those of the motion; in /cell
// the map's result for the cell. Groups without content are omitted. Displacements are in A0 and forces over
// the hammer's weight, as in maps; everything else is in SI units.
#pragma once

#include <vector>

#include "job/job.hpp"
#include "map_file/table.hpp"
#include "quantities/fields.hpp"
#include "scene/scales.hpp"
#include "trace/trace.hpp"

namespace peterka::trace {

[[nodiscard]] std::vector<map_file::Table> tables_of(const Trace& trace, const scene::Scales& scales);

// A cell as scalars of a group: what a map of this job stores, in the units of its file.
[[nodiscard]] std::vector<map_file::Table> cell_tables(const char* group, const quantities::StoredCell& cell,
                                                       const job::Job& job);

// The job of a map that stores everything that proves the regime of a traced cell.
[[nodiscard]] job::Job with_proofs(job::Job job);

}  // namespace peterka::trace
