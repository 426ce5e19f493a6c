#include "run/mean_lives.hpp"

#include <bit>
#include <cmath>

#include "job/job.hpp"
#include "noise/mean_life.hpp"
#include "regime/engine.hpp"
#include "support/random_numbers.hpp"

namespace peterka {
namespace {

// Disturbances of a motion depend on the cell and the motion alone, not on the order in which motions are
// found.
std::uint64_t seed_of(std::int64_t cell, const scene::State<double>& point) {
    RandomNumbers seed(static_cast<std::uint64_t>(cell));
    RandomNumbers of_point(seed.bits() ^ std::bit_cast<std::uint64_t>(point[0]));
    return of_point.bits() ^ std::bit_cast<std::uint64_t>(point[1]);
}

// Without the cubic term, where that map returns to the orbit's point: then the motion was found without it.
std::optional<noise::MeanLife> life_of(const scene::Cell& cell, const job::Job& job,
                                       const scene::State<double>& point, int period, std::uint64_t seed,
                                       std::int64_t budget) {
    const noise::Disturbance disturbance = noise::disturbance_of(job.noise, cell.scales);
    const auto with = [&](const scene::Oscillator<double>& oscillator,
                          const regime::EngineSettings& settings) -> std::optional<noise::MeanLife> {
        noise::DisturbedMap map(oscillator, settings, disturbance);
        const auto home = noise::Home::of(map, point, period, job.noise.most_to_relax());
        if (!home) return std::nullopt;
        return noise::mean_life(map, *home, budget, seed);
    };
    const bool may_omit =
        job.solver.engine == job::EngineChoice::automatic || job.solver.engine == job::EngineChoice::exact;
    if (may_omit && !regime::has_nonlinear_contact(cell.oscillator)) {
        auto life = with(scene::without_cubic(cell.oscillator), {});
        if (life || cell.oscillator.cubic == 0) return life;
    }
    const double reach = std::abs(point[0] + cell.oscillator.gap) + std::abs(point[1]);
    return with(cell.oscillator, regime::EngineByReach(cell.oscillator, job.solver, reach).settings());
}

// Of a cell's result or of one of its attractors.
template <class Motion>
void add(const scene::Scene& scene, std::int64_t row, std::int64_t column, Motion& motion, double share) {
    if (!scene.job().noise.any() || !cell::has_period(motion.regime)) return;
    const scene::Cell cell = scene.cell(row, column);
    const scene::State<double> point(motion.orbit_displacement - cell.oscillator.gap, motion.orbit_velocity);
    if (!point.allFinite()) return;
    const auto life = life_of(cell, scene.job(), point, std::max(motion.period, 1),
                              seed_of(row * scene.columns() + column, point),
                              std::llround(share * static_cast<double>(scene.job().noise.cycles)));
    if (!life) return;
    const double period = cell.oscillator.period();
    motion.mean_life = life->mean * period;
    motion.mean_life_error = life->error * period;
    motion.mean_life_least = life->least * period;
}

}  // namespace

void add_mean_life(const scene::Scene& scene, std::int64_t row, std::int64_t column, cell::CellResult& result,
                   double share) {
    if (scene.job().starts.count == 0) add(scene, row, column, result, share);
}

void add_mean_life(const scene::Scene& scene, std::int64_t row, std::int64_t column,
                   cell::CellAttractor& attractor, double share) {
    add(scene, row, column, attractor, share);
}

}  // namespace peterka
