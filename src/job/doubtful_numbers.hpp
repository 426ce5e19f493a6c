// Numbers that are sound and look as if given in another unit; each adds one sentence to `texts`.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// Hammer and stop: grams, N/mm, Ns/mm, rad/s, per cent. A number that differs from cell to cell is told only if
// it is doubtful in all cells.
void add_doubtful_rig(const Job& job, std::vector<std::string>& texts);

// Frequencies, gaps, starts and times: millimetres, rad/s, kHz, milliseconds, or the ratio of the other key.
void add_doubtful_place(const Job& job, std::vector<std::string>& texts);

// Spreads of [uncertainty]: a percentage, or another unit. For a job whose [uncertainty] is sound.
void add_doubtful_spreads(const Job& job, std::vector<std::string>& texts);

}  // namespace peterka::job
