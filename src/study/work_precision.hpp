// Work and precision: the error of every method in a few cells, against its time per forcing cycle.
//
// Each run starts on the cell's stable periodic orbit, known to 1e-17 from the reference, and follows it for
// job.study.cycles forcing cycles; then one period is compared with the reference. All methods do the same
// work: state, Jacobian and contacts, to which the batched engine adds the force, as it always does; the time
// is that of the fastest of job.study.repeats. The batched engine follows all cells together, and each cell's
// time is its share of the batch's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "scene/scales.hpp"
#include "study/batch_trial.hpp"
#include "study/method.hpp"
#include "study/reference.hpp"
#include "study/table.hpp"

namespace peterka::study {

class WorkPrecision {
  public:
    // Stored as int8; part of the file format.
    enum class TrialEnd : std::int8_t { done = 0, failed = 1, other_orbit = 2 };

    // The result of one run in one cell.
    struct Result {
        TrialEnd outcome = TrialEnd::failed;
        double error_peak_force = 0;   // relative
        double error_state = 0;        // of (delta, delta') over 1 + their size
        double error_impact_time = 0;  // in forcing cycles
        double seconds_per_cycle = 0;
    };

    explicit WorkPrecision(const job::Job& job);

    [[nodiscard]] std::int64_t tasks() const;
    [[nodiscard]] Result solve(std::int64_t task) const;
    [[nodiscard]] std::vector<Table> tables(std::span<const Result> results) const;
    [[nodiscard]] std::string summary(std::span<const Result> results) const;

  private:
    struct Trial {
        Oscillator<double> oscillator;
        State<double> start;
    };
    using Orbit = std::optional<ReferenceOrbit>;
    struct TimedOrbit {
        double seconds_per_cycle = 0;
        std::vector<Observation> cycles;  // one period
    };

    // The cell's orbit, computed on first use: a rank needs few, and a check none.
    [[nodiscard]] const Orbit& orbit(std::size_t cell) const;
    // All cells in one batch, run on first use.
    [[nodiscard]] const BatchTrial& batch_trial() const;
    // The run on the cell's orbit; nothing if it fails.
    [[nodiscard]] std::optional<TimedOrbit> follow(const Run& run, std::size_t cell) const;

    job::Study study_;
    job::SteadyState budget_;
    double force_ratio_;  // F/(m g0) per F/(k A0)
    std::vector<Run> runs_;
    std::vector<Trial> cells_;
    mutable std::vector<std::optional<Orbit>> orbits_;
    mutable std::optional<BatchTrial> batch_trial_;
};

}  // namespace peterka::study
