// Live measurements of one run, kept in group /run of the file: they differ from run to run.
#pragma once

#include <string>

namespace peterka::map_file {

struct RunFacts {
    int ranks = 1;
    double compute_seconds = 0;  // wall time of this run [s]
    std::string hosts;           // names of the machines it ran on
    double solve_seconds = 0;    // of these, until all cells were solved and stored, excluding start-up [s]
};

}  // namespace peterka::map_file
