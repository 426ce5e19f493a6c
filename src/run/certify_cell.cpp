#include "run/certify_cell.hpp"

#include <algorithm>

#include "certificate/certify.hpp"
#include "job/cell_numbers.hpp"
#include "run/audit_sample.hpp"

namespace peterka {
namespace {

// A point of a sweep that continues from the previous one doesn't begin at [start].
bool begins_at_start(const job::Job& job, std::int64_t row) {
    return job.kind != job::Kind::sweep || job.sweep.branch(row).direction == job::Direction::independent;
}

}  // namespace

bool wants_certificate(const job::Job& job, std::int64_t row, std::int64_t column) {
    const std::int64_t cells = job.cells();
    const std::int64_t samples = std::min(job.certificate.cells, cells);
    if (samples == 0 || samples == cells) return samples > 0;
    const std::int64_t cell = row * job.columns.points + column;
    const auto near = static_cast<std::int64_t>(static_cast<double>(cell) / static_cast<double>(cells) *
                                                static_cast<double>(samples));
    for (std::int64_t index = std::max<std::int64_t>(near - 1, 0); index < std::min(near + 2, samples);
         ++index) {
        if (audited_cell(index, samples, cells) == cell) return true;
    }
    return false;
}

void certify_cell(const job::Job& job, std::int64_t row, std::int64_t column, cell::CellResult& result) {
    if (!wants_certificate(job, row, column)) return;
    const certificate::Certificate certificate = certificate::certify(
        job::numbers_at(job, row, column), {.regime = result.regime,
                                            .orbit = {.impacts = result.impacts,
                                                      .period = result.period,
                                                      .displacement = result.orbit_displacement,
                                                      .velocity = result.orbit_velocity}});
    result.certified = certificate.verdict;
    if (!certificate.proved()) return;
    if (!begins_at_start(job, row)) result.certified = cell::Certified::orbit;
    result.force_lower = certificate.force_ratio.lo;
    result.force_upper = certificate.force_ratio.hi;
    result.impact_speed_lower = certificate.impact_speed.lo;
    result.impact_speed_upper = certificate.impact_speed.hi;
    result.stability_margin = certificate.stability_margin;
}

}  // namespace peterka
