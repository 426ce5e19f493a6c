// Beginning and end of a cycle for all lanes; included by kernel-inl.hpp.
#if defined(PETERKA_BATCH_BEGIN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_BEGIN_INL_HPP
#undef PETERKA_BATCH_BEGIN_INL_HPP
#else
#define PETERKA_BATCH_BEGIN_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The swing of the flights of a vector of lanes, and the margin of their bound.
template <Law law, bool own>
HWY_INLINE V Kernel<law, own>::begin_flight(std::size_t i, V delta, V velocity, Mask which) const {
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
    double* margin = lanes_[Field::margin] + i;
    store(choose(which, hull_margin(fourth, load(lanes_[Field::step] + i)), load(margin)), margin);
    return amplitude;
}

// Puts all lanes at forcing phase 0, sorted by phase of motion.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::begin() {
    const V zero = all(0);
    queues_.twin.size = 0;
    real_ = every();
    const auto set = [&](Mask which, V x, double* to)
                         HWY_ATTR { store(everywhere(which) ? x : choose(which, x, load(to)), to); };
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
        const V next = load(lanes_[Field::next] + i);
        const Mask ended = (next >= all(steps_)) & (next < all(never));
        if (!any(ended)) continue;
        const Index index = index_from(i);
        const V delta = load(lanes_[Field::delta] + i);
        const V velocity = load(lanes_[Field::velocity] + i);
        set(ended, delta, lanes_[Field::start_delta] + i);
        set(ended, velocity, lanes_[Field::start_velocity] + i);

        const auto& rig = rig_at(i);
        const V force = mul_add(all(rig.stiffness), delta, all(rig.damping) * velocity);
        const Mask at_stop = delta == zero;
        const Mask rests = at_stop & (velocity == zero);  // with a rigid stop
        const Mask flight = (delta < zero) | (at_stop & (rigid ? velocity < zero : velocity <= zero));
        const Mask contact = rigid ? rests & presses(load(lanes_[Field::press_from] + i),
                                                     load(lanes_[Field::press_to] + i), zero)
                                   : ~flight & ((force > zero) | at_stop);
        const Mask unloaded = rigid ? none() : ~(flight | contact);
        const V amplitude = begin_flight(i, delta, velocity, ended);
        // to the twin: non-finite values; with a rigid stop, starts that strike it at once, fall from it or lie
        // inside it
        const Mask finite = (abs(amplitude) < all(1e100)) & (flight | contact | unloaded);
        push(index, ended & ~finite, queues_.twin);
        set(ended, choose(flight & finite, zero, all(never)), lanes_[Field::next] + i);

        const auto phase = choose(
            flight, patterns(trajectory::Phase::flight),
            choose(contact, patterns(trajectory::Phase::contact), patterns(trajectory::Phase::unloaded)));
        store(choose(ended, phase, load(lanes_.pattern + i)), lanes_.pattern + i);
        set(ended, zero, lanes_[Field::impacts] + i);
        set(ended, choose(contact, all(1), zero), lanes_[Field::touched] + i);
        set(ended, choose(flight, all(1), zero), lanes_[Field::separated] + i);
        set(ended, zero, lanes_[Field::peak_force] + i);
        set(ended, zero, lanes_[Field::largest_displacement] + i);
        if constexpr (rigid) {
            const V press_to = load(lanes_[Field::press_to] + i);
            const Mask pressed = presses(load(lanes_[Field::press_from] + i), press_to, zero);
            set(ended, choose(pressed & ~contact, press_to, zero), lanes_[Field::chain_until] + i);
            set(ended, zero, lanes_[Field::chain_impacts] + i);
            set(ended, zero, lanes_[Field::swallowed] + i);
            set(ended, zero, lanes_[Field::chatter] + i);
            for (const Field field : {Field::chain_impulse, Field::impact_speed, Field::impulse,
                                      Field::contact_time, Field::contact_work}) {
                set(ended, zero, lanes_[field] + i);
            }
            store(choose(ended, phase, load(lanes_.chain_pattern + i)), lanes_.chain_pattern + i);
        }
        if constexpr (!cubic) {
            const V u = delta + load(lanes_[Field::gap] + i);
            set(ended, amplitude, lanes_[Field::leg_amplitude] + i);
            set(ended, sqrt(mul_add(u, u, velocity * velocity)), lanes_[Field::leg_energy] + i);
        }
        set(ended, zero, lanes_[Field::leg_start] + i);
        const Matrix2 identity{all(1), zero, zero, all(1)};
        store_jacobian(everywhere(ended) ? identity : choose(ended, identity, load_jacobian(lanes_, i)), lanes_,
                       i);
        const Moments start{delta, velocity, zero, all(1)};
        const Mask goes = ended & finite;
        if constexpr (cubic) {
            push(index, zero, zero, start, goes & contact, queues_.held_contacts);
            push(index, zero, zero, start, goes & unloaded, queues_.held_releases);
        } else {
            push(index, all(steps_), zero, start, goes & contact, queues_.contacts);
            push(index, all(steps_), zero, start, goes & unloaded, queues_.releases);
        }
    }
}

// Closes the last leg of each lane.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::finish() {
    const V zero = all(0);
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
        const V next = load(lanes_[Field::next] + i);
        const Mask ended = (next >= all(steps_)) & (next < all(never));
        if (!any(ended)) continue;
        const V impacts = load(lanes_[Field::impacts] + i);
        store(choose(impacts > zero, all(1), load(lanes_[Field::touched] + i)), lanes_[Field::touched] + i);
        const V start = load(lanes_[Field::leg_start] + i);
        const Mask flies = ended & (start >= zero);
        const V duration = mul_sub(all(steps_), load(lanes_[Field::step] + i), start);
        const V eta = load(lanes_[Field::frequency] + i);
        const V bound = min(load(lanes_[Field::swing] + i) + load(lanes_[Field::leg_amplitude] + i),
                            mul_add(eta * eta, duration, load(lanes_[Field::leg_energy] + i)));
        const V largest = load(lanes_[Field::largest_displacement] + i);
        store(choose(flies, max(largest, bound), largest), lanes_[Field::largest_displacement] + i);
        const auto& rig = rig_at(i);
        const Matrix2 f =
            flow(sine_cosine(all(rig.flight_rate) * duration), exp_of(all(-rig.damping_ratio) * duration),
                 all(rig.damping_ratio), all(1), all(1 / rig.flight_rate));
        const Matrix2 j = load_jacobian(lanes_, i);
        store_jacobian(choose(flies, f * j, j), lanes_, i);
    }
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
