#include "scene/uncertain_cells.hpp"

#include <algorithm>

#include "job/axis_key.hpp"

namespace peterka::scene {

UncertainCells::UncertainCells(const job::Job& job) : draws_(job) {
    if (has_axis(job, job::is_of_rig)) return;
    const job::CellNumbers own = numbers_in(job);
    for (std::size_t n = 0; n < count(); ++n) rigs_.push_back(rig(own, n));
}

UncertainCells::Rig UncertainCells::rig(const job::CellNumbers& own, std::size_t n) const {
    const job::CellNumbers numbers = draws_.rig(own, n);
    return {numbers, oscillator_of(numbers), scales_of(numbers)};
}

Cell UncertainCells::cell(const job::CellNumbers& own, std::size_t n) const {
    Rig rig = rigs_.empty() ? this->rig(own, n) : rigs_[n];
    draws_.place(rig.numbers, own, n);
    const double gap = rig.numbers.gap_ratio();
    const double frequency = rig.numbers.frequency_ratio();
    rig.oscillator.gap = gap;
    rig.oscillator.frequency = frequency;
    const double depth_m = (own.displacement_ratio() - own.gap_ratio()) * own.cart.amplitude_m;
    const double deepest = std::max(depth_m, 0.0) / rig.scales.length_m;
    const double delta = std::min(rig.numbers.displacement_ratio() - gap, deepest);
    return {rig.oscillator, {delta, rig.numbers.velocity_ratio() - frequency}, rig.scales};
}

}  // namespace peterka::scene
