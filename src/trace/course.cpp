#include "trace/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "regime/followed_trajectory.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"
#include "support/errors.hpp"
#include "trace/carrier.hpp"

namespace peterka::trace {

namespace {

using regime::EngineSettings;
using scene::Oscillator;
using trajectory::Cycle;
using trajectory::Recorder;

const char* in_words(Cycle<double>::Outcome outcome) {
    switch (outcome) {
        case Cycle<double>::Outcome::too_many_events:
            return "more contacts in one cycle than any physical motion has";
        case Cycle<double>::Outcome::not_finite:
            return "the state leaves the range of numbers";
        case Cycle<double>::Outcome::solver_failed:
            return "the integrator gives up";
        case Cycle<double>::Outcome::inside_stop:
            return "the hammer starts inside the rigid stop";
        case Cycle<double>::Outcome::done:
            break;
    }
    return "done";
}

// Successive cycles of one scene.
class Cycles {
  public:
    Cycles(const Oscillator<double>& oscillator, const EngineSettings& settings, const State<double>& start)
        : map_(regime::make_cycle_map(oscillator, settings)), state_(start) {}

    [[nodiscard]] const State<double>& state() const { return state_; }

    void advance(Recorder<double>* recorder) {
        const Cycle<double> cycle =
            std::visit([&](auto& map) -> Cycle<double> { return map(state_, recorder); }, map_);
        if (cycle.outcome != Cycle<double>::Outcome::done) {
            throw Failure(
                ExitCode::too_many_failures,
                fmt::format("the motion can't be followed beyond {} cycles: {}. No file is written; compare "
                            "with another solver.engine.",
                            done_, in_words(cycle.outcome)));
        }
        state_ = cycle.end;
        ++done_;
    }

  private:
    regime::CycleMap map_;
    State<double> state_;
    std::int64_t done_ = 0;
};

// The maps' rule for the cubic spring, with the largest displacement of this very motion.
void choose_engine(Course& course, const job::Solver& solver) {
    const Oscillator<double> whole = course.oscillator;
    const bool may_omit = solver.engine == job::EngineChoice::automatic &&
                          (whole.cubic == 0 || solver.omit_tolerance > 0) &&
                          !regime::has_nonlinear_contact(whole);
    Watcher nobody;
    double reach = EngineSettings{}.largest_displacement;
    if (may_omit) {
        course.oscillator = without_cubic(whole);
        if (whole.cubic == 0) return;
        reach = follow(course, nobody).displacement_bound;
        if (regime::effect_of_cubic(whole, reach) <= solver.omit_tolerance) return;
    }
    course.oscillator = whole;
    regime::EngineByReach engine(whole, solver, reach);
    do {
        course.settings = engine.settings();
        reach = follow(course, nobody).displacement_bound;
    } while (engine.must_change(reach));
    course.settings = engine.settings();
}

Course at_rest(const scene::Scene& scene) {
    const job::Job& job = scene.job();
    const scene::Cell cell = scene.cell(0, 0);
    Course course{cell.oscillator, {}, cell.start, job.trace.duration_s * scene.scales().frequency_rad_per_s};
    choose_engine(course, job.solver);
    return course;
}

void skip(Course& course, std::int64_t cycles) {
    Cycles passing(course.oscillator, course.settings, course.start);
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle) passing.advance(nullptr);
    course.start = passing.state();
    course.skipped = cycles;
}

Course driven(const scene::Scene& scene) {
    const job::Job& job = scene.job();
    regime::CycleBroker broker;
    const regime::CellResult result = regime::complete(regime::solve_cell(broker, scene, 0, 0), broker);
    const Carrier carrier = carrier_of(broker, result);
    Course course{carrier.oscillator, carrier.settings, scene.cell(0, 0).start,
                  static_cast<double>(job.trace.cycles) * carrier.oscillator.period()};
    course.cell = result;
    if (job.trace.from == job::TraceBegin::start) return course;
    if (std::isfinite(result.orbit_displacement)) {
        course.start = {result.orbit_displacement - course.oscillator.gap, result.orbit_velocity};
        course.period = result.period;
    } else {
        skip(course, regime::first_that_counts(job.steady_state));
    }
    return course;
}

}  // namespace

Course prepare(const scene::Scene& scene) {
    return scene.job().operating_point.frequency_ratio > 0 ? driven(scene) : at_rest(scene);
}

trajectory::Totals<double> follow(const Course& course, Watcher& watcher) {
    constexpr double rounding = 1e-12;  // of a length meant to be whole periods
    const double period = course.oscillator.period();
    const auto cycles = static_cast<std::int64_t>(std::ceil(course.length / period * (1 - rounding)));
    Recorder<double> recorder(trajectory::Detail::energy, watcher);
    Cycles passing(course.oscillator, course.settings, course.start);
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle) {
        watcher.begin_cycle(period * static_cast<double>(cycle));
        passing.advance(&recorder);
    }
    watcher.finish(passing.state(), trajectory::phase_of(course.oscillator, passing.state()));
    return recorder.totals();
}

}  // namespace peterka::trace
