// Labels: how the regimes of a map depend on the engine and its tolerance.
//
// The whole map of the job is solved by every engine at each of job.study.tolerances. A run's changed share is
// the share of the cells whose (regime, p, q) differs from that of the reference run: the exact engine, or
// arkode at the smallest tolerance if a cubic spring rules out an exact one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "regime/cell_result.hpp"
#include "scene/scene.hpp"
#include "study/method.hpp"
#include "study/table.hpp"

namespace peterka::study {

class Labels {
  public:
    // The result of one run in one cell.
    struct Result {
        regime::Regime regime = regime::Regime::failed;
        std::int32_t impacts = 0;
        std::int32_t period = 0;
        double seconds = 0;

        [[nodiscard]] bool same_label(const Result& other) const {
            return regime == other.regime && impacts == other.impacts && period == other.period;
        }
        [[nodiscard]] bool is_proved() const {
            return regime != regime::Regime::unresolved && regime != regime::Regime::failed;
        }
    };

    explicit Labels(const job::Job& job);

    [[nodiscard]] std::int64_t tasks() const { return std::ssize(runs_) * cells(); }
    [[nodiscard]] Result solve(std::int64_t task) const;
    [[nodiscard]] std::vector<Table> tables(std::span<const Result> results) const;
    [[nodiscard]] std::string summary(std::span<const Result> results) const;

  private:
    struct EngineRun {
        regime::Engine engine;
        Run run;
    };
    struct Shares {
        std::vector<double> changed;
        std::vector<double> unproved;
        std::vector<double> seconds;  // per cell
    };
    [[nodiscard]] std::int64_t cells() const { return scene_.rows() * scene_.columns(); }
    [[nodiscard]] Shares shares(std::span<const Result> results) const;

    scene::Scene scene_;
    std::vector<EngineRun> runs_;
    std::size_t reference_ = 0;
};

}  // namespace peterka::study
