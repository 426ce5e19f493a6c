// An engine that fails in an arbitrary cycle of a search: the
// cell fails and states the reason, or its claim is correct.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "regime/cycle_broker.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

using trajectory::Cycle;
using Outcome = Cycle<double>::Outcome;

struct Fault {
    Outcome outcome;
    Status status;
};

constexpr Fault faults[] = {{Outcome::too_many_events, Status::too_many_events},
                            {Outcome::not_finite, Status::not_finite},
                            {Outcome::solver_failed, Status::solver_failed},
                            {Outcome::inside_stop, Status::solver_failed}};

// The data returned with a fault depend on the engine; here the worst case.
Cycle<double> broken_cycle(Outcome outcome) {
    Cycle<double> cycle;
    cycle.outcome = outcome;
    cycle.end.setConstant(std::numeric_limits<double>::quiet_NaN());
    return cycle;
}

struct Case {
    std::string name;
    EngineSettings settings;
    scene::Oscillator<double> oscillator;
    trajectory::Detail detail = trajectory::Detail::force;
};

struct Solved {
    CellResult result;
    std::int64_t computed = 0;  // cycles, including those ordered ahead and finally not needed
};

Solved solve(const Case& cell, std::int64_t broken = -1, Outcome outcome = Outcome::done) {
    CycleBroker broker;
    CycleMap map = make_cycle_map(cell.oscillator, cell.settings);
    const auto search = find_steady_state(broker, cell.oscillator, testing::start_at(cell.oscillator), {},
                                          cell.settings, {cell.detail}, {});
    search.start();
    std::int64_t n = 0;
    while (!search.done()) {
        const CycleRequest& order = broker.order();
        scene::State<double> from = order.from;
        std::vector<Cycle<double>> cycles;
        for (bool goes_on = true; goes_on && cycles.size() < order.cycles; ++n) {
            cycles.push_back(n == broken
                                 ? broken_cycle(outcome)
                                 : std::visit([&](auto& engine) { return engine(from, order.recorder); }, map));
            from = cycles.back().end;
            goes_on = cycles.back().outcome == Outcome::done;
        }
        broker.serve(cycles);
    }
    return {search.result(), n};
}

std::vector<Case> cases() {
    std::vector<Case> all;
    const auto add = [&](const std::string& name, double frequency, double gap, trajectory::Detail detail) {
        const auto oscillator = testing::paper_rig(testing::beam_170mm, frequency, gap);
        all.push_back({"exact_" + name, {}, oscillator, detail});
        all.push_back({"split_" + name, {Engine::split, 1e-6, 10}, oscillator, detail});
        all.push_back({"cvode_" + name, {Engine::cvode, 1e-6}, oscillator, detail});
        all.push_back({"arkode_" + name, {Engine::arkode, 1e-6}, oscillator, detail});
        all.back().oscillator.cubic = all[all.size() - 3].oscillator.cubic = 8e-7;
    };
    add("one_a_cycle", 2.0, 0.0, trajectory::Detail::force);
    add("doubled", 2.75, 0.0, trajectory::Detail::force);
    add("nearly_doubled", 2.65, 0.0, trajectory::Detail::force);
    add("no_impact", 3.0, 4.0, trajectory::Detail::contacts);
    return all;
}

class FaultyEngine : public ::testing::TestWithParam<Case> {};

TEST_P(FaultyEngine, IsSeen) {
    const Case& cell = GetParam();
    const auto [sound, computed] = solve(cell);
    ASSERT_EQ(sound.status, Status::verified);
    const std::int64_t last = computed - 1;
    for (std::int64_t broken = 0; broken <= last; ++broken) {
        const Fault& fault = faults[broken == last ? 0 : broken % std::ssize(faults)];
        const CellResult cell_result = solve(cell, broken, fault.outcome).result;
        SCOPED_TRACE("cycle " + std::to_string(broken) + " of " + std::to_string(computed));
        if (cell_result.regime == Regime::failed) {
            EXPECT_EQ(cell_result.status, fault.status);
            EXPECT_TRUE(std::isnan(cell_result.peak_force));
            EXPECT_TRUE(std::isnan(cell_result.impact_rate));
        } else {  // the cycle was not needed, or belonged to an orbit attempt while another one succeeded
            if (broken == last) {  // it checks the force
                EXPECT_EQ(cell_result.status, Status::imprecise);
            }
            EXPECT_EQ(cell_result.regime, sound.regime);
            EXPECT_EQ(cell_result.impacts, sound.impacts);
            EXPECT_EQ(cell_result.period, sound.period);
            EXPECT_NEAR(cell_result.peak_force, sound.peak_force, 1e-5 * sound.peak_force);
        }
    }
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Search, FaultyEngine, ::testing::ValuesIn(cases()), name_of_case);

}  // namespace
}  // namespace peterka::regime
