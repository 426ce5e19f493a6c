// How a cycle begins and ends for all lanes: see kernel-inl.hpp, which includes this.
#if defined(PETERKA_BATCH_BEGIN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_BEGIN_INL_HPP
#undef PETERKA_BATCH_BEGIN_INL_HPP
#else
#define PETERKA_BATCH_BEGIN_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// How far the flights of a vector of lanes swing, and the margin that their bound keeps.
template <bool measure, bool jacobian, bool cubic, bool own>
HWY_INLINE V Kernel<measure, jacobian, cubic, own>::begin_flight(std::size_t i, V delta, V velocity) const {
    const auto& rig = rig_at(i);
    const V gap = load(lanes_[Field::gap] + i);
    const V eta = load(lanes_[Field::frequency] + i);
    const V static_position = cubic ? load(lanes_[Field::static_position] + i) : -gap;
    const V x = delta - static_position - load(lanes_[Field::flight_im] + i);
    const V v = neg_mul_add(eta, load(lanes_[Field::flight_re] + i), velocity);
    const V inverse_rate = cubic ? all(1) / load(lanes_[Field::flight_rate] + i) : all(1 / rig.flight_rate);
    const V quadrature = mul_add(all(rig.damping_ratio), x, v) * inverse_rate;
    const V amplitude = sqrt(mul_add(x, x, quadrature * quadrature));
    const V square = eta * eta;
    const V stiff = cubic ? load(lanes_[Field::flight_square] + i) : all(1);
    const V fourth = mul_add(square * square, load(lanes_[Field::swing] + i), stiff * stiff * amplitude);
    store(hull_margin(fourth, load(lanes_[Field::step] + i)), lanes_[Field::margin] + i);
    return amplitude;
}

// All lanes at forcing phase 0, sorted by phase.
template <bool measure, bool jacobian, bool cubic, bool own>
HWY_ATTR void Kernel<measure, jacobian, cubic, own>::begin() {
    const V zero = all(0);
    queues_.twin.size = 0;
    next_ = 0;
    real_ = every();
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
        const Index index = index_from(i);
        const V delta = load(lanes_.delta(0) + i);
        const V velocity = load(lanes_.velocity(0) + i);
        store(delta, lanes_[Field::start_delta] + i);
        store(velocity, lanes_[Field::start_velocity] + i);

        const auto& rig = rig_at(i);
        const V force = mul_add(all(rig.stiffness), delta, all(rig.damping) * velocity);
        const Mask at_stop = delta == zero;
        const Mask flight = (delta < zero) | (at_stop & (velocity <= zero));
        const Mask contact = ~flight & ((force > zero) | at_stop);
        const Mask unloaded = ~(flight | contact);
        const Mask in_use = load(lanes_[Field::in_use] + i) > zero;
        const V amplitude = begin_flight(i, delta, velocity);
        store(choose(flight, zero, all(never)), lanes_[Field::next] + i);

        const auto phase = choose(
            flight, patterns(trajectory::Phase::flight),
            choose(contact, patterns(trajectory::Phase::contact), patterns(trajectory::Phase::unloaded)));
        store(phase, lanes_.pattern + i);
        store(zero, lanes_[Field::impacts] + i);
        store(choose(contact, all(1), zero), lanes_[Field::touched] + i);
        store(choose(flight, all(1), zero), lanes_[Field::separated] + i);
        if constexpr (measure) {
            store(zero, lanes_[Field::peak_force] + i);
            store(zero, lanes_[Field::largest_displacement] + i);
        }
        if constexpr (Gathered::bounds_legs) {
            const V u = delta + load(lanes_[Field::gap] + i);
            store(amplitude, lanes_[Field::leg_amplitude] + i);
            store(sqrt(mul_add(u, u, velocity * velocity)), lanes_[Field::leg_energy] + i);
        }
        if constexpr (keeps_legs) store(zero, lanes_[Field::leg_start] + i);
        if constexpr (jacobian) store_jacobian({all(1), zero, zero, all(1)}, lanes_, i);
        const Moments start{delta, velocity, zero, all(1)};
        push(index, zero, zero, start, in_use & contact, cubic ? queues_.held_contacts : queues_.contacts);
        push(index, zero, zero, start, in_use & unloaded, cubic ? queues_.held_releases : queues_.releases);
        // idle lanes, and numbers that are none
        const Mask idle = ~in_use;
        if (any(idle)) store(choose(idle, all(never), load(lanes_[Field::next] + i)), lanes_[Field::next] + i);
        const Mask finite = abs(amplitude) < all(1e100);
        const Mask wild = ~finite & in_use;
        if (any(wild)) {
            push(index, wild, queues_.twin);
            store(choose(wild, all(never), load(lanes_[Field::next] + i)), lanes_[Field::next] + i);
        }
    }
}

// Closes the last leg of each lane.
template <bool measure, bool jacobian, bool cubic, bool own>
HWY_ATTR void Kernel<measure, jacobian, cubic, own>::finish() {
    const V zero = all(0);
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
        const V impacts = load(lanes_[Field::impacts] + i);
        store(choose(impacts > zero, all(1), load(lanes_[Field::touched] + i)), lanes_[Field::touched] + i);
        if constexpr (measure || jacobian) {
            const V start = load(lanes_[Field::leg_start] + i);
            const Mask flies = start >= zero;
            const V duration = mul_sub(all(steps_), load(lanes_[Field::step] + i), start);
            if constexpr (measure) {
                const V eta = load(lanes_[Field::frequency] + i);
                const V bound = min(load(lanes_[Field::swing] + i) + load(lanes_[Field::leg_amplitude] + i),
                                    mul_add(eta * eta, duration, load(lanes_[Field::leg_energy] + i)));
                const V largest = load(lanes_[Field::largest_displacement] + i);
                store(choose(flies, max(largest, bound), largest), lanes_[Field::largest_displacement] + i);
            }
            if constexpr (jacobian) {
                const auto& rig = rig_at(i);
                const Matrix2 f = flow(sine_cosine(all(rig.flight_rate) * duration),
                                       exp_of(all(-rig.damping_ratio) * duration), all(rig.damping_ratio),
                                       all(1), all(1 / rig.flight_rate));
                const Matrix2 j = load_jacobian(lanes_, i);
                store_jacobian(choose(flies, f * j, j), lanes_, i);
            }
        }
    }
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
