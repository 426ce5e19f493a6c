// The fields of a map: the datasets of its quantities, which creating, writing, checking and sizing a file all
// follow. A new field is a row in cell/quantities.hpp.
#pragma once

#include <vector>

#include "cell/quantities.hpp"
#include "hdf5/variable.hpp"
#include "job/job.hpp"
#include "regime/cell_result.hpp"
#include "scene/scales.hpp"

namespace peterka::quantities {

using cell::StoredAttractor;
using cell::StoredCell;
using cell::StoredOutcome;

template <template <cell::Units> class Numbers>
struct FieldOf {
    hdf5::Variable variable;
    const cell::QuantityOf<Numbers>* quantity;
};

using Field = FieldOf<cell::Result>;
using AttractorField = FieldOf<cell::Attractor>;
using OutcomeField = FieldOf<cell::Outcome>;

// The fields that a job stores, in the order of the table.
[[nodiscard]] std::vector<Field> stored_fields(const job::Job& job);

// Those of each attractor of a cell; none without [starts].
[[nodiscard]] std::vector<AttractorField> stored_attractor_fields(const job::Job& job);

// Those of each outcome of the rigs drawn for a cell; none without [uncertainty].
[[nodiscard]] std::vector<OutcomeField> stored_outcome_fields(const job::Job& job);

// The columns of a basin's table of attractors.
[[nodiscard]] std::vector<Field> attractor_fields();

// The cell in the units of the file, every NaN the same NaN, so that equal results are equal bytes.
[[nodiscard]] StoredCell in_file_units(const cell::CellResult& cell, const scene::Scales& scales);
[[nodiscard]] StoredAttractor in_file_units(const cell::CellAttractor& attractor, const scene::Scales& scales);
[[nodiscard]] StoredOutcome in_file_units(const cell::CellOutcome& outcome, const scene::Scales& scales);

}  // namespace peterka::quantities
