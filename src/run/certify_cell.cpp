#include "run/certify_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "job/cell_numbers.hpp"
#include "regime/same_orbit.hpp"
#include "run/audit_sample.hpp"
#include "scene/scales.hpp"

namespace peterka {
namespace {

using certificate::OfStart;

OfStart of_start(const job::Certificate& asked) {
    if (!asked.starts) return OfStart::if_it_keeps_its_phase;
    return asked.many_digits ? OfStart::in_many_digits : OfStart::through_impacts;
}

// A point of a sweep that continues from the previous one doesn't begin at [start].
bool begins_at_start(const job::Job& job, std::int64_t row) {
    return job.kind != job::Kind::sweep || job.sweep.branch(row).direction == job::Direction::independent;
}

// Of a cell whose label no longer depends on rounding: its force, F/(m g0), may still be further away from the
// proved bounds than allowed.
cell::Status status_of_force(const job::Job& job, const certificate::Certificate& certificate, double force) {
    const double allowed = std::max(job.solver.tolerance, job.solver.omit_tolerance);
    const bool is_off = force < certificate.force_ratio.lo * (1 - allowed) ||
                        force > certificate.force_ratio.hi * (1 + allowed);
    return is_off ? cell::Status::imprecise : cell::Status::verified;
}

// Of a cell's result or of one of its attractors.
template <class Numbers>
certificate::Claim claim_of(const Numbers& motion) {
    return {.regime = motion.regime,
            .orbit = {.impacts = motion.impacts,
                      .period = motion.period,
                      .displacement = motion.orbit_displacement,
                      .velocity = motion.orbit_velocity}};
}

template <class Numbers>
void put_into(const certificate::Certificate& certificate, Numbers& motion) {
    motion.certified = certificate.verdict;
    if (!certificate.proved()) return;
    motion.force_lower = certificate.force_ratio.lo;
    motion.force_upper = certificate.force_ratio.hi;
    motion.impact_speed_lower = certificate.impact_speed.lo;
    motion.impact_speed_upper = certificate.impact_speed.hi;
    motion.stability_margin = certificate.stability_margin;
}

void tell_last_impact(double cycles, cell::CellResult& result) {
    if (result.last_impact != cell::goes_on) result.last_impact = static_cast<std::int32_t>(std::ceil(cycles));
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

std::optional<certificate::SettledStart> certify_cell(const job::Job& job, std::int64_t row,
                                                      std::int64_t column, cell::CellResult& result) {
    if (!wants_certificate(job, row, column)) return std::nullopt;
    const bool starts = begins_at_start(job, row);
    const job::CellNumbers numbers = job::numbers_at(job, row, column);
    const certificate::Certificate certificate = certificate::certify(
        numbers, claim_of(result), starts ? of_start(job.certificate) : OfStart::if_it_keeps_its_phase);
    put_into(certificate, result);
    if (!certificate.proved()) return std::nullopt;
    if (!starts) result.certified = cell::Certified::orbit;
    if (result.certified == cell::Certified::start && result.status == cell::Status::rounding) {
        result.status =
            status_of_force(job, certificate, scene::scales_of(numbers).force_ratio() * result.peak_force);
        tell_last_impact(certificate.last_event, result);
    }
    return certificate.elsewhere;
}

scene::State<double> start_of_search(const scene::Cell& cell, const certificate::SettledStart& settled) {
    return {settled.displacement - cell.oscillator.gap, settled.velocity};
}

bool replaces(const job::Job& job, std::int64_t row, std::int64_t column,
              const certificate::SettledStart& settled, const cell::CellResult& result,
              cell::CellResult& there) {
    if (same_label(result, there) && regime::same_orbit(result, there)) return false;
    certify_cell(job, row, column, there);
    if (there.certified != cell::Certified::start) return false;
    there.sensitivity = result.sensitivity;
    const std::int64_t cycles = std::int64_t{result.cycles} + there.cycles;
    there.cycles =
        static_cast<std::int32_t>(std::min<std::int64_t>(cycles, std::numeric_limits<std::int32_t>::max()));
    tell_last_impact(settled.cycles, there);
    return true;
}

void certify_attractor(const job::Job& job, std::int64_t row, std::int64_t column,
                       cell::CellAttractor& attractor) {
    if (!job.certificate.attractors || !wants_certificate(job, row, column)) return;
    const certificate::Certificate certificate =
        certificate::certify(job::numbers_at(job, row, column), claim_of(attractor));
    put_into(certificate, attractor);
    if (certificate.proved()) attractor.certified = cell::Certified::orbit;
}

}  // namespace peterka
