#include "run/elasticities.hpp"

#include <algorithm>
#include <cmath>

#include "elasticity/orbit_elasticity.hpp"
#include "job/stored_quantities.hpp"

namespace peterka {
namespace {

// Whether the chain of events is the cell's own motion: not, if their results differ by more than the cell's
// may be off. The impact speed on a rigid stop isn't known unless it is requested.
bool is_of_the_cell(const job::Job& job, double largest, const cell::CellResult& cell) {
    const double own = job::is_rigid(job.contact) ? cell.impact_speed : cell.peak_force;
    const double allowed = 1e-6 + std::max(job.solver.tolerance, job.solver.omit_tolerance);
    return std::isnan(own) || std::abs(largest / own - 1) <= allowed;
}

}  // namespace

RequestedElasticities::RequestedElasticities(const job::Job& job)
    : job_(&job), requested_(job::stored_quantities(job)) {
    std::erase_if(requested_,
                  [](const cell::Quantity* quantity) { return quantity->keeping.by_number == nullptr; });
}

void RequestedElasticities::add_to(std::int64_t row, std::int64_t column, cell::CellResult& result) const {
    if (requested_.empty() || result.regime != cell::Regime::periodic) return;
    const job::CellNumbers numbers = job::numbers_at(*job_, row, column);
    const auto of_orbit = elasticity::orbit_elasticity(numbers, {.impacts = result.impacts,
                                                                 .period = result.period,
                                                                 .displacement = result.orbit_displacement,
                                                                 .velocity = result.orbit_velocity});
    if (!of_orbit || !is_of_the_cell(*job_, of_orbit->largest, result)) return;
    for (const cell::Quantity* quantity : requested_) {
        quantity->store(result, elasticity::elasticity_by(quantity->keeping.by_number, numbers, *of_orbit));
    }
}

}  // namespace peterka
