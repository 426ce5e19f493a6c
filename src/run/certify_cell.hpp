// What is proved about a cell just solved (certificate/certify.hpp), if the job requests a proof.
#pragma once

#include <cstdint>

#include "cell/result.hpp"
#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Whether to certify a cell: all cells, or one at random from each of certificate.cells equal stretches of
// cells.
[[nodiscard]] bool wants_certificate(const job::Job& job, std::int64_t row, std::int64_t column);

// Adds the certificate to the result, if requested for the cell.
void certify_cell(const job::Job& job, std::int64_t row, std::int64_t column, cell::CellResult& result);

// The same for an attractor of the cell, whose orbit is proved, not which starts lead there.
void certify_attractor(const job::Job& job, std::int64_t row, std::int64_t column,
                       cell::CellAttractor& attractor);

}  // namespace peterka
