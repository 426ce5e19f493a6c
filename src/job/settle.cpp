#include "job/settle.hpp"

#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"

namespace peterka::job {

bool has_rig(const Job& job) {
    const Hammer& hammer = job.hammer;
    return hammer.mass_kg > 0 && (hammer.natural_frequency_hz || hammer.stiffness_n_per_m) &&
           (hammer.damping_ns_per_m || hammer.damping_ratio) && job.cart.amplitude_m > 0;
}

void take_first_values(Job& job) {
    CellNumbers numbers = numbers_in(job);
    if (!job.columns.over.empty()) set_number(numbers, job.columns.over, job.columns.from);
    if (!job.rows.over.empty()) set_number(numbers, job.rows.over, job.rows.from);
    job.hammer = numbers.hammer;
    job.cart = numbers.cart;
    job.contact = numbers.contact;
    job.start = numbers.start;
}

void settle_place(Job& job) {
    if (!has_rig(job)) return;
    const CellNumbers numbers = numbers_in(job);
    job.operating_point.frequency_ratio = numbers.frequency_ratio();
    job.operating_point.gap_ratio = numbers.gap_ratio();
}

void settle_start(Job& job) {
    if (!has_rig(job)) return;
    const CellNumbers numbers = numbers_in(job);
    job.start.displacement_ratio = numbers.displacement_ratio();
    job.start.velocity_ratio = numbers.velocity_ratio();
}

}  // namespace peterka::job
