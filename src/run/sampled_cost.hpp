// What the cells of a job cost, foretold from some of them, solved here and now by this process.
#pragma once

#include <cstdint>

#include "job/job.hpp"

namespace peterka {

struct SampledCost {
    std::int64_t cells = 0;       // of the sample
    double spent = 0;             // on it [s of one core]
    double cycles = 0;            // mean of a cell [forcing cycles]
    double seconds = 0;           // of a cell, of one core
    double relative_error = 0;    // standard error of both means, over them; 0 if all were solved
    double unseen_share = 0;      // what cells that were given up early may take more, over the mean, at most
    double integrated_cycle = 0;  // of an engine of the audit [s of one core]; 0 without audit
};

// For a map, basin, sweep or the coarse map of curves; without proofs, audit and critical kicks. Of many starts
// or drawn rigs a part is solved, since all cost about the same. Takes half a second, or, where each cycle is
// integrated, a second or two.
[[nodiscard]] SampledCost sample_cost(const job::Job& job);

struct SampledLives {
    std::int64_t cells = 0;     // of the sample
    double spent = 0;           // on it [s of one core]
    double seconds = 0;         // of the lives of a cell, or of a sweep's point, of one core
    double relative_error = 0;  // standard error of that, over it; 0 if all were tried
};

// Of the lives under [noise] of a map or sweep: of a few cells they are computed, which takes three seconds,
// and more where each cell does. Of a cell 200,000 cycles, or 1000 by integrators, and the rest in proportion.
[[nodiscard]] SampledLives sample_lives(const job::Job& job);

// Time of a forcing cycle of such a job with everything that it entails, on one core with AVX-512, as measured
// once (with AVX2 a cycle in the batch takes 1.5 times as long) [s].
[[nodiscard]] double usual_cycle_time(const job::Job& job);

}  // namespace peterka
