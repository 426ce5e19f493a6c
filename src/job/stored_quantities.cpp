#include "job/stored_quantities.hpp"

#include <algorithm>

#include "job/cell_numbers.hpp"
#include "job/first_order_spread.hpp"

namespace peterka::job {

namespace {

// Whether a job keeps what is stored then, but for what it keeps on request.
bool keeps(const Job& job, cell::StoredWhen kept) {
    const bool certifies = job.certificate.cells > 0;
    const bool certifies_attractors = certifies && job.certificate.attractors && job.starts.count > 0;
    switch (kept) {
        case cell::StoredWhen::always:
            return true;
        case cell::StoredWhen::in_refined_maps:
            return job.refine.levels > 0;
        case cell::StoredWhen::in_sweeps:
            return job.kind == Kind::sweep;
        case cell::StoredWhen::of_many_starts:
            return job.starts.count > 0;
        case cell::StoredWhen::of_rigid_stops:
            return is_rigid(job.contact);
        case cell::StoredWhen::of_certificates:
            return certifies;
        case cell::StoredWhen::of_certificates_of_rigid_stops:
            return certifies && is_rigid(job.contact);
        case cell::StoredWhen::of_certified_attractors:
            return certifies_attractors;
        case cell::StoredWhen::of_certified_attractors_of_rigid_stops:
            return certifies_attractors && is_rigid(job.contact);
        case cell::StoredWhen::of_uncertain_rigs:
            return job.uncertainty.rigs > 0;
        case cell::StoredWhen::of_uncertain_rigs_with_forces:
            return job.uncertainty.rigs > 0 && !is_rigid(job.contact);
        case cell::StoredWhen::of_uncertain_rigs_on_rigid_stops:
            return job.uncertainty.rigs > 0 && is_rigid(job.contact);
        case cell::StoredWhen::of_disturbed_cells:
            return job.noise.any() && job.starts.count == 0;
        case cell::StoredWhen::of_disturbed_attractors:
            return job.noise.any() && job.starts.count > 0;
        case cell::StoredWhen::on_request:
            break;
    }
    return false;
}

}  // namespace

bool stores(const Job& job, const cell::Quantity& quantity) {
    if (quantity.since > job.layout) return false;
    if (quantity.keeping.kept != cell::StoredWhen::on_request) return keeps(job, quantity.keeping.kept);
    if (const auto of_all = quantity.keeping.field_of_all; of_all && job.output.has(*of_all)) {
        if (is_uncertain(job, quantity.keeping.by_number)) return true;
        const auto gives = [&](const CellNumbers& cell) {
            return gives_number(cell, quantity.keeping.by_number);
        };
        if (std::ranges::any_of(numbers_at_corners(job), gives)) return true;
    }
    const OptionalField field = quantity.keeping.field.value();
    if (field == OptionalField::critical_kick && job.starts.count > 0) return false;  // per attractor instead
    return job.output.has(field) || (job.kind == Kind::basin && field == OptionalField::orbit);
}

std::vector<const cell::Quantity*> stored_quantities(const Job& job) {
    std::vector<const cell::Quantity*> stored;
    for (const cell::Quantity& quantity : cell::quantities) {
        if (stores(job, quantity)) stored.push_back(&quantity);
    }
    return stored;
}

std::vector<const cell::AttractorQuantity*> stored_attractor_quantities(const Job& job) {
    std::vector<const cell::AttractorQuantity*> stored;
    if (job.starts.count == 0) return stored;
    for (const cell::AttractorQuantity& quantity : cell::attractor_quantities) {
        const std::optional<OptionalField> field = quantity.keeping.field;
        if (quantity.since > job.layout) continue;
        if (field ? job.output.has(*field) : keeps(job, quantity.keeping.kept)) stored.push_back(&quantity);
    }
    return stored;
}

std::span<const cell::OutcomeQuantity> stored_outcome_quantities(const Job& job) {
    return job.uncertainty.rigs > 0 ? cell::outcome_quantities : std::span<const cell::OutcomeQuantity>();
}

}  // namespace peterka::job
