// What is proved of a cell that was just solved (certificate/certify.hpp), where the job wants it tried.
#pragma once

#include <cstdint>

#include "cell/result.hpp"
#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Whether a cell is among those to try: all, or one at random of each of as many equal stretches of cells.
[[nodiscard]] bool wants_certificate(const job::Job& job, std::int64_t row, std::int64_t column);

// Adds the certificate to the result; nothing where none is wanted.
void certify_cell(const job::Job& job, std::int64_t row, std::int64_t column, cell::CellResult& result);

}  // namespace peterka
