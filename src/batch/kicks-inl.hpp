// The kicks of a cubic spring on lanes at the stop, and the last kicks of a cycle; included by kernel-inl.hpp.
#if defined(PETERKA_BATCH_KICKS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_KICKS_INL_HPP
#undef PETERKA_BATCH_KICKS_INL_HPP
#else
#define PETERKA_BATCH_KICKS_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The hammer is at the stop at the grid point, and waits for the kick there.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::hold(const Cells& cells, V delta, V velocity, V grid_point, Mask which,
                                     Queue& held) {
    if (!any(which)) return;
    const Index point = index_of(grid_point);
    const Moments m{delta, velocity, gather(grid_.sine.data(), point), gather(grid_.cosine.data(), point)};
    push(cells.index, grid_point, grid_point * cells.step, m, real_ & which, held);
    put(all(never), lanes_[Field::next], cells.index, which);
}

// Kicks the lanes at the stop at a grid point (at the ends of a cycle by half, the other half belongs to the
// adjacent cycle), and queues them to be followed to the next grid point.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::kick_held(Queue& held, Queue& ready, bool pressed) {
    const Waiting w = take(held);
    const Cells cells = cells_of(w.lanes);
    const Mask ends = w.end == all(steps_);
    const V part = choose(ends | (w.end == all(0)), all(0.5), all(1));
    const Kick kick(part * all(cells.rig.cubic) * cells.step, cells.gap, w.moment.delta);
    const V velocity = w.moment.velocity - kick.speed;
    const Matrix2 j = kicked(gather_jacobian(lanes_, w.lanes), kick.slope);
    scatter(j.e10, lanes_[Field::jacobian_10], w.lanes);
    scatter(j.e11, lanes_[Field::jacobian_11], w.lanes);
    // a kick that changes the sign of the force would be an event
    const V force = mul_add(all(cells.rig.stiffness), w.moment.delta, all(cells.rig.damping) * velocity);
    const Mask presses = force > all(0);
    const Mask same = (w.moment.delta >= all(0)) & (pressed ? presses : ~presses);
    leave_to_twin(cells, ~same);
    put(w.moment.delta, lanes_[Field::delta], w.lanes, same & ends);
    put(velocity, lanes_[Field::velocity], w.lanes, same & ends);
    put(all(steps_) + all(1), lanes_[Field::next], w.lanes, same & ends);
    const Moments kicked{w.moment.delta, velocity, w.moment.sine, w.moment.cosine};
    push(w.lanes, w.end + all(1), w.time, kicked, real_ & same & ~ends, ready);
}

// The half kick at the end of the cycle on lanes in flight.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::finish_kicks() {
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
        const V impacts = load(lanes_[Field::impacts] + i);
        store(choose(impacts > all(0), all(1), load(lanes_[Field::touched] + i)), lanes_[Field::touched] + i);
        const Mask flies = load(lanes_[Field::next] + i) == all(steps_);
        const V delta = load(lanes_[Field::delta] + i);
        const Kick kick(all(0.5 * rig_at(i).cubic) * load(lanes_[Field::step] + i),
                        load(lanes_[Field::gap] + i), delta);
        const V velocity = load(lanes_[Field::velocity] + i);
        const V kicked_velocity = velocity - kick.speed;
        store(choose(flies, kicked_velocity, velocity), lanes_[Field::velocity] + i);
        const Mask finite = abs(delta) + abs(kicked_velocity) < all(1e100);  // large kicks can diverge
        push(index_from(i), flies & ~finite, queues_.twin);
        const Matrix2 j = load_jacobian(lanes_, i);
        store_jacobian(choose(flies, kicked(j, kick.slope), j), lanes_, i);
    }
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
