// What is proved about a cell just solved (certificate/certify.hpp), if the job requests a proof.
#pragma once

#include <cstdint>
#include <optional>

#include "cell/result.hpp"
#include "certificate/certify.hpp"
#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Whether to certify a cell: all cells, or one at random from each of certificate.cells equal stretches of
// cells.
[[nodiscard]] bool wants_certificate(const job::Job& job, std::int64_t row, std::int64_t column);

// Adds the certificate to the result, if requested for the cell. Where the start was followed and found to
// lead elsewhere, returns where its motion has settled: rounding, or an error of the search, decided the label.
std::optional<certificate::SettledStart> certify_cell(const job::Job& job, std::int64_t row,
                                                      std::int64_t column, cell::CellResult& result);

// For such a cell: the start of a search that finds the motion on which it settled, and whether the result
// `there` of that search takes the place of the cell's own, as it does if the cell's start is proved to lead
// to its motion. If so, what depends on the way from the start is added to it.
[[nodiscard]] scene::State<double> start_of_search(const scene::Cell& cell,
                                                   const certificate::SettledStart& settled);
[[nodiscard]] bool replaces(const job::Job& job, std::int64_t row, std::int64_t column,
                            const certificate::SettledStart& settled, const cell::CellResult& result,
                            cell::CellResult& there);

// The same for an attractor of the cell, whose orbit is proved, not which starts lead there.
void certify_attractor(const job::Job& job, std::int64_t row, std::int64_t column,
                       cell::CellAttractor& attractor);

}  // namespace peterka
