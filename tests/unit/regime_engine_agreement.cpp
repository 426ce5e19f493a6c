// Every engine on every row of tests/data/cells.csv: each finds the periodic orbit of its own map near the
// reference, and their forces, impacts and energies agree pairwise within the requested errors.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "integrators/integrated_cycle_map.hpp"
#include "reference_cells.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::regime {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using namespace trajectory;
using testing::ReferenceCell;

using Map = std::function<Cycle<double>(const State<double>&, Recorder<double>*)>;

struct CycleEngine {
    std::string name;
    double error;  // relative, at most
    std::function<Map(const Oscillator<double>&)> map_of;
};

constexpr double tolerance = 1e-6;
constexpr double rounding = 1e-10;

CycleEngine integrated(const std::string& name, Integrator integrator) {
    return {name, tolerance, [integrator](const Oscillator<double>& oscillator) -> Map {
                // std::function requires a copyable callable
                auto map = std::make_shared<IntegratedCycleMap>(oscillator, integrator, tolerance);
                return
                    [map](const State<double>& x, Recorder<double>* recorder) { return (*map)(x, recorder); };
            }};
}

std::vector<CycleEngine> engines() {
    return {{"exact", rounding,
             [](const Oscillator<double>& oscillator) -> Map { return ExactCycleMap<double>(oscillator); }},
            {"split", rounding,
             [](const Oscillator<double>& oscillator) -> Map { return SplitCycleMap<double>(oscillator, 12); }},
            integrated("cvode_adams", Integrator::cvode_adams),
            integrated("cvode_bdf", Integrator::cvode_bdf),
            integrated("arkode_explicit", Integrator::arkode_explicit),
            integrated("arkode_implicit", Integrator::arkode_implicit)};
}

struct Orbit {
    bool found = false;
    Totals<double> totals;
};

// The orbit of the engine's own map, by Newton's method from the reference's point on it.
Orbit orbit_of(const Map& map, const ReferenceCell& cell) {
    State<double> x = cell.end;
    if (!x.allFinite()) {
        const CellResult exact = find_steady_state(cell.oscillator, cell.start, {});
        x = {exact.orbit_displacement - cell.oscillator.gap, exact.orbit_velocity};
    }
    for (int step = 0; step < 3; ++step) {
        State<double> end = x;
        Jacobian<double> jacobian = Jacobian<double>::Identity();
        for (int q = 0; q < cell.period; ++q) {
            const auto cycle = map(end, nullptr);
            if (cycle.outcome != Cycle<double>::Outcome::done) return {};
            end = cycle.end;
            jacobian = (cycle.jacobian * jacobian).eval();
        }
        x += (Jacobian<double>::Identity() - jacobian).partialPivLu().solve(end - x);
    }
    Recorder<double> recorder(Detail::energy);
    for (int pass = 0; pass < 2; ++pass) {  // an impact may extend across phase 0: the second pass has it whole
        recorder.reset_totals();
        State<double> end = x;
        for (int q = 0; q < cell.period; ++q) end = map(end, &recorder).end;
        if (!((end - x).norm() < tolerance * (1 + x.norm()))) return {};
        if (!recorder.is_open()) break;
    }
    return {true, recorder.totals()};
}

struct Quantity {
    std::string name;
    double value;
    double scale;  // reference scale of a relative error
};

std::vector<Quantity> quantities(const Totals<double>& totals) {
    const double energy = totals.impact_speed * totals.impact_speed;
    return {{"peak force", totals.peak_force(), totals.peak_force()},
            {"impact speed", totals.impact_speed, totals.impact_speed},
            {"impulse", totals.impulse, totals.impulse},
            {"contact time", totals.contact_time, totals.contact_time},
            {"contact work", totals.contact_work, energy},
            {"drive work", totals.drive_work, energy},
            {"damper work", totals.damper_work, energy},
            {"energy over a period", totals.drive_work - totals.damper_work - totals.contact_work, energy},
            {"largest displacement", totals.largest_displacement, totals.largest_displacement}};
}

TEST(EngineAgreement, HoldsOnEveryReferenceCell) {
    const auto all = engines();
    int compared = 0;
    for (const ReferenceCell& cell : testing::read_cells()) {
        if (cell.impacts == 0) continue;
        SCOPED_TRACE(cell.name);
        std::vector<std::vector<Quantity>> found;
        for (const CycleEngine& engine : all) {
            const Orbit orbit = orbit_of(engine.map_of(cell.oscillator), cell);
            ASSERT_TRUE(orbit.found) << engine.name;
            EXPECT_EQ(orbit.totals.impacts, cell.impacts) << engine.name;
            EXPECT_NEAR(orbit.totals.peak_force() * cell.force_ratio_per_unit, cell.peak_force_ratio,
                        engine.error * cell.peak_force_ratio)
                << engine.name;
            EXPECT_GE(orbit.totals.displacement_bound, orbit.totals.largest_displacement * (1 - tolerance));
            found.push_back(quantities(orbit.totals));
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                for (std::size_t n = 0; n < found[i].size(); ++n) {
                    const Quantity& one = found[i][n];
                    EXPECT_NEAR(one.value, found[j][n].value, (all[i].error + all[j].error) * one.scale)
                        << one.name << " of " << all[i].name << " and " << all[j].name;
                }
            }
        }
        ++compared;
    }
    EXPECT_GE(compared, 50);
}

}  // namespace
}  // namespace peterka::regime
