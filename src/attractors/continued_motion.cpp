#include "attractors/continued_motion.hpp"

#include <algorithm>
#include <optional>

#include "regime/engine.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/same_orbit.hpp"
#include "regime/solve_cell.hpp"
#include "trajectory/free_flight.hpp"

namespace peterka::attractors {

namespace {

using regime::Regime;

// A search from the orbit itself recurs at once, and is proved after a few more periods.
constexpr std::int64_t fewest_cycles = 300;
constexpr std::int64_t periods_to_prove = 6;

bool coincide(const KnownMotion& a, const KnownMotion& b, const scene::Oscillator<double>& oscillator) {
    const double tolerance = oscillator.cubic != 0 ? regime::same_point_with_and_without : regime::same_point;
    return a.period == b.period && regime::coincide(a.displacement, b.displacement, tolerance) &&
           regime::coincide(a.velocity, b.velocity, tolerance);
}

scene::State<double> point_of(const KnownMotion& motion, const scene::Oscillator<double>& oscillator) {
    return {motion.displacement - oscillator.gap, motion.velocity};
}

// Newton's method uses the closed form, and hence linear springs: accurate enough where the cubic part may be
// omitted.
bool may_correct(const KnownMotion& from, const scene::Oscillator<double>& oscillator,
                 const job::Solver& solver) {
    return from.regime == Regime::periodic && !regime::has_nonlinear_contact(oscillator) &&
           (oscillator.cubic == 0 ||
            regime::effect_of_cubic(oscillator, regime::EngineSettings{}.largest_displacement) <=
                solver.omit_tolerance);
}

// The stable orbit with as many cycles and contacts; nothing where Newton's method finds none.
Task<std::optional<KnownMotion>> corrected(regime::CycleBroker& broker, scene::Oscillator<double> oscillator,
                                           KnownMotion from) {
    regime::StroboscopicMap map(oscillator, {}, broker);
    auto orbit = co_await regime::find_orbit(map, map.scaled(point_of(from, oscillator)), from.period);
    if (!orbit || !orbit->touched || !regime::is_stable(*orbit) || regime::has_smaller_period(*orbit))
        co_return std::nullopt;
    regime::put_lowest_point_first(*orbit);
    const scene::State<double> point = map.unscaled(orbit->point());
    from.displacement = point[0] + oscillator.gap;
    from.velocity = point[1];
    co_return from;
}

}  // namespace

bool is_known(const KnownMotion& motion, std::span<const KnownMotion> known,
              const scene::Oscillator<double>& oscillator) {
    return std::ranges::any_of(known, [&](const KnownMotion& each) {
        if (each.regime != motion.regime) return false;
        return motion.regime != Regime::periodic ||
               (each.impacts == motion.impacts && coincide(each, motion, oscillator));
    });
}

job::Job job_of_continuation(job::Job job) {
    job.output.fields.clear();
    job.steady_state.max_cycles = std::min(
        job.steady_state.max_cycles, std::max(fewest_cycles, periods_to_prove * job.steady_state.max_period));
    return job;
}

bool may_stay_free(const scene::Oscillator<double>& oscillator) {
    return trajectory::FreeFlight<double>(without_cubic(oscillator)).may_last();
}

Task<cell::CellResult> free_motion(regime::CycleBroker& broker, const job::Job& job, scene::Cell cell) {
    cell.start = trajectory::FreeFlight<double>(without_cubic(cell.oscillator)).steady();
    if (const auto at_once = regime::solve_at_once(job, cell)) co_return *at_once;
    co_return co_await regime::solve_cell(broker, job, cell);
}

Task<cell::CellResult> continued_motion(regime::CycleBroker& broker, const job::Job& job, scene::Cell cell,
                                        KnownMotion from, std::span<const KnownMotion> known) {
    if (may_correct(from, cell.oscillator, job.solver)) {
        const auto reached = co_await corrected(broker, without_cubic(cell.oscillator), from);
        if (!reached || is_known(*reached, known, cell.oscillator)) co_return cell::CellResult{};
        from = *reached;
    }
    cell.start = point_of(from, cell.oscillator);
    co_return co_await regime::solve_cell(broker, job, cell);
}

}  // namespace peterka::attractors
