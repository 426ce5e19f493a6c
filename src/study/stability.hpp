// Stability: the battery of stiff and extreme scenes, solved with every engine and judged by the reference; and
// the limit of an infinitely stiff stop.
//
// An engine agrees if its claim (regime, p, q) is that of the reference and its peak force is within ten times
// the requested tolerance; close to grazing and to bifurcations, where forces and regimes depend on the scene's
// last digits, within ten times the change caused by perturbing gap or frequency by the tolerance. An engine
// says why not if it is unresolved or failed, with a status. A claim that the reference contradicts is wrong,
// and so is any claim about a motion that the reference never saw settle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "job/job.hpp"
#include "regime/cell_result.hpp"
#include "study/table.hpp"

namespace peterka::study {

class Stability {
  public:
    // Stored as int8; part of the file format.
    enum class Judgement : std::int8_t { agrees = 0, says_why_not = 1, wrong = 2, not_for_this_scene = 3 };
    static constexpr std::size_t engines = 4;

    // The result of one engine in one scene.
    struct OfEngine {
        Judgement outcome = Judgement::not_for_this_scene;
        regime::Regime regime = regime::Regime::unresolved;
        regime::Status status = regime::Status::verified;
        std::int32_t impacts = 0;
        std::int32_t period = 0;
        double error_peak_force = regime::unknown;  // relative
        double energy_imbalance = regime::unknown;  // of one period, over the work of the drive
        double seconds = regime::unknown;
    };
    // The results of one scene with all engines, or of one rung of the stiffness ladder.
    struct Result {
        std::array<OfEngine, engines> of_engines;
        double speed_difference = regime::unknown;
    };

    explicit Stability(job::Job job) : job_(std::move(job)) {}

    [[nodiscard]] std::int64_t tasks() const;
    [[nodiscard]] Result solve(std::int64_t task) const;
    [[nodiscard]] std::vector<Table> tables(std::span<const Result> results) const;
    [[nodiscard]] std::string summary(std::span<const Result> results) const;

  private:
    [[nodiscard]] Result solve_scene(std::int64_t number) const;

    job::Job job_;
};

}  // namespace peterka::study
