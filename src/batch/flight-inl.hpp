// Free flight of a vector of lanes, in closed form, and enclosures of stretches of it.
//
//     delta'' + 2 zeta delta' + w2 (delta - static_position) = eta^2 sin(theta)
//
// with w2 = 1 and static_position = -gap without a cubic spring.
#if defined(PETERKA_BATCH_FLIGHT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_FLIGHT_INL_HPP
#undef PETERKA_BATCH_FLIGHT_INL_HPP
#else
#define PETERKA_BATCH_FLIGHT_INL_HPP
#endif

#include <type_traits>

#include "batch/functions-inl.hpp"
#include "batch/lanes.hpp"
#include "batch/rig.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// A point of a trajectory: the hammer's state, and the forcing's phase.
struct Moments {
    V delta, velocity, sine, cosine;
};
HWY_INLINE Moments choose(Mask which, const Moments& yes, const Moments& no) {
    return {choose(which, yes.delta, no.delta), choose(which, yes.velocity, no.velocity),
            choose(which, yes.sine, no.sine), choose(which, yes.cosine, no.cosine)};
}
HWY_INLINE SineCosine turned(V sine, V cosine, SineCosine by) {
    return {mul_add(sine, by.cosine, cosine * by.sine), neg_mul_add(sine, by.sine, cosine * by.cosine)};
}

// The numbers of batch/rig.hpp for a vector of lanes with different rigs. Constants that are expensive to
// derive are omitted: they would not pay for a few impacts.
struct OwnRigs {
    // fetch: loads a field for these lanes.
    template <class Fetch>
    HWY_INLINE explicit OwnRigs(Fetch fetch)
        : damping_ratio(fetch(Field::damping_ratio)),
          flight_rate(fetch(Field::flight_rate)),
          cubic(fetch(Field::cubic)),
          stiffness(fetch(Field::stiffness)),
          damping(fetch(Field::damping)),
          lag(damping / stiffness),
          contact_decay(mul_add(damping, all(0.5), damping_ratio)),
          contact_square(stiffness + all(1)),
          contact_frequency(sqrt(contact_square)),
          contact_rate(fetch(Field::contact_rate)),
          restitution(fetch(Field::restitution)) {}

    V damping_ratio, flight_rate, cubic, stiffness, damping, lag;
    V contact_decay, contact_square, contact_frequency, contact_rate;
    V restitution;
    static constexpr bool weakly_damped = false;
};

// The constants of a vector of lanes. Whose: const Rig& if all lanes share it, otherwise OwnRigs.
template <class Whose>
struct CellsOf {
    template <bool cubic>
    HWY_INLINE CellsOf(const Whose& its_rig, const Lanes& lanes, double steps, Index which,
                       std::bool_constant<cubic>)
        : rig(its_rig),
          index(which),
          eta(gather(lanes[Field::frequency], which)),
          gap(gather(lanes[Field::gap], which)),
          step(gather(lanes[Field::step], which)),
          re(gather(lanes[Field::flight_re], which)),
          im(gather(lanes[Field::flight_im], which)),
          drive(eta * eta),
          per_step(eta * all(steps * 0.15915494309189533577)) {
        if constexpr (cubic) {
            square = gather(lanes[Field::flight_square], which);
            frequency = sqrt(square);
            rate = gather(lanes[Field::flight_rate], which);
            inverse_rate = all(1) / rate;
            static_position = gather(lanes[Field::static_position], which);
            contact_square = square + all(rig.stiffness);
            contact_frequency = sqrt(contact_square);
            contact_rate = gather(lanes[Field::contact_rate], which);
            inverse_contact_rate = all(1) / contact_rate;
            contact_static_position = square * static_position / contact_square;
        } else {
            square = all(1);
            frequency = all(1);
            rate = all(rig.flight_rate);
            inverse_rate = all(1 / rig.flight_rate);
            static_position = -gap;
            contact_square = all(rig.contact_square);
            contact_frequency = all(rig.contact_frequency);
            contact_rate = all(rig.contact_rate);
            inverse_contact_rate = all(1 / rig.contact_rate);
            contact_static_position = gap * all(-1 / rig.contact_square);
        }
    }

    Whose rig;
    Index index;
    V eta, gap, step, re, im;
    V drive;     // amplitude of the forcing
    V per_step;  // 1/step

    // The linear equations: the rig's or, with a cubic spring, each cell's own.
    V square, frequency;   // w2 of flight, and its root
    V rate, inverse_rate;  // damped frequency
    V static_position;
    V contact_square, contact_frequency;
    V contact_rate, inverse_contact_rate;
    V contact_static_position;
};

// Derivatives of delta in flight.
struct Derivatives {
    V second, third, fourth;
};
HWY_INLINE Derivatives derivatives(const auto& cells, const Moments& m) {
    const V damping = all(-2 * cells.rig.damping_ratio);
    const V wave = cells.drive * m.sine;
    const V second =
        mul_add(damping, m.velocity, neg_mul_add(cells.square, m.delta - cells.static_position, wave));
    const V third =
        mul_add(damping, second, mul_sub(cells.drive * cells.eta, m.cosine, cells.square * m.velocity));
    const V fourth = mul_add(damping, third, neg_mul_sub(cells.drive, wave, cells.square * second));
    return {second, third, fourth};
}

// The quantity whose rise through zero is an event, and its derivatives along a flight.
struct Rise {
    V value, slope, second, third, fourth;
};
HWY_INLINE Rise rise_of_position(const Moments& m, const Derivatives& d) {
    return {m.delta, m.velocity, d.second, d.third, d.fourth};
}
// For the force over the stop's stiffness: where it rises while delta > 0, the stop presses again.
HWY_INLINE Rise rise_of_force(const auto& cells, const Moments& m, const Derivatives& d) {
    const V lag = all(cells.rig.lag);
    const V square = cells.drive * cells.drive;
    const V fifth = mul_add(all(-2 * cells.rig.damping_ratio), d.fourth,
                            neg_mul_sub(square * cells.eta, m.cosine, cells.square * d.third));
    return {mul_add(lag, m.velocity, m.delta), mul_add(lag, d.second, m.velocity),
            mul_add(lag, d.third, d.second), mul_add(lag, d.fourth, d.third), mul_add(lag, fifth, d.fourth)};
}

// The flow of a flight of any length.
HWY_INLINE Matrix2 flight_flow(const auto& cells, V t) {
    return flow(sine_cosine(cells.rate * t), exp_of(all(-cells.rig.damping_ratio) * t),
                all(cells.rig.damping_ratio), cells.square, cells.inverse_rate);
}

// The same within one step of the grid.
HWY_INLINE Matrix2 soon_flow(const auto& cells, V t) {
    const V exponent = all(-cells.rig.damping_ratio) * t;
    const V decay = cells.rig.weakly_damped ? small_exp(exponent) : exp_of(exponent);
    return flow(small_sine_cosine(cells.rate * t), decay, all(cells.rig.damping_ratio), cells.square,
                cells.inverse_rate);
}

template <class Cells>
class Flight {
  public:
    HWY_INLINE Flight(const Cells& cells, const Moments& start)
        : cells_(cells),
          start_(start),
          x_(start.delta - cells.static_position - mul_add(cells.re, start.sine, cells.im * start.cosine)),
          v_(start.velocity - cells.eta * mul_sub(cells.re, start.cosine, cells.im * start.sine)) {}

    // Amplitude of the homogeneous part, which only decays; and an upper bound that exceeds it by at most a
    // twelfth.
    [[nodiscard]] HWY_INLINE V amplitude() const {
        const V y = quadrature();
        return sqrt(mul_add(x_, x_, y * y));
    }
    [[nodiscard]] HWY_INLINE V amplitude_bound() const {
        const V a = abs(x_);
        const V b = abs(quadrature());
        return mul_add(min(a, b), all(0.41422), max(a, b));
    }
    // Bound of |delta''''|; swing: amplitude of the steady response.
    [[nodiscard]] HWY_INLINE V fourth_derivative_bound(V swing) const {
        return mul_add(cells_.drive * cells_.drive, swing, cells_.square * cells_.square * amplitude_bound());
    }

    [[nodiscard]] HWY_INLINE Moments at(V t) const {
        return at(t, sine_cosine(cells_.rate * t), sine_cosine(cells_.eta * t));
    }
    // The same within one grid step.
    [[nodiscard]] HWY_INLINE Moments soon(V t) const {
        return at(t, small_sine_cosine(cells_.rate * t), small_sine_cosine(cells_.eta * t));
    }

  private:
    [[nodiscard]] HWY_INLINE V quadrature() const {
        return mul_add(all(cells_.rig.damping_ratio), x_, v_) * cells_.inverse_rate;
    }
    [[nodiscard]] HWY_INLINE Moments at(V t, SineCosine own, SineCosine forcing) const {
        const V exponent = all(-cells_.rig.damping_ratio) * t;
        const V decay = cells_.rig.weakly_damped ? small_exp(exponent) : exp_of(exponent);
        const Matrix2 f = flow(own, decay, all(cells_.rig.damping_ratio), cells_.square, cells_.inverse_rate);
        const SineCosine phase = turned(start_.sine, start_.cosine, forcing);
        const V steady = mul_add(cells_.re, phase.sine, cells_.im * phase.cosine);
        const V steady_velocity = cells_.eta * mul_sub(cells_.re, phase.cosine, cells_.im * phase.sine);
        return {f.upper(x_, v_) + steady + cells_.static_position, f.lower(x_, v_) + steady_velocity,
                phase.sine, phase.cosine};
    }

    const Cells& cells_;
    const Moments& start_;
    V x_, v_;  // homogeneous part at the start
};

// The kick by the remainder of a relative cubic spring after its linear part at the stop (Strang splitting, see
// trajectory/split_cycle_map.hpp). impulse: cubic coefficient times the time represented by the kick.
struct Kick {
    V speed;  // subtracted from the velocity
    V slope;  // its derivative by delta
    HWY_INLINE Kick(V impulse, V gap, V delta) {
        const V force = impulse * delta;
        const V stretch = all(3) * gap;
        speed = force * delta * (stretch + delta);
        slope = force * mul_add(all(3), delta, stretch + stretch);
    }
};

// A stretch of flight in Bernstein form: delta = sum of b_i C(4, i) s^i (1 - s)^(4 - i), with an upper bound as
// the middle coefficient: the cubic Hermite interpolant differs from delta by at most max|delta''''| l^4/24 s^2
// (1 - s)^2.
struct Hull {
    V b0, b1, b2, b3, b4;
    HWY_INLINE Hull(V delta0, V velocity0, V delta1, V velocity1, V length, V margin)
        : b0(delta0),
          b1(mul_add(length * all(0.25), velocity0, delta0)),
          b3(neg_mul_add(length * all(0.25), velocity1, delta1)),
          b4(delta1) {
        b2 = mul_add(all(2.0 / 3), b1 + b3, mul_add(all(-1.0 / 6), b0 + b4, margin));
    }
    // A lower bound of delta.
    [[nodiscard]] HWY_INLINE V lowest(V margin) const {
        return min(min(min(b0, b1), min(b3, b4)), neg_mul_add(all(2), margin, b2));
    }
    // Largest |delta + gap|, for delta known to stay below `highest`.
    [[nodiscard]] HWY_INLINE V displacement_bound(V gap, V highest, V margin) const {
        const V top = min(max(max(max(b0, b1), max(b3, b4)), b2), highest);
        return max(abs(top + gap), abs(lowest(margin) + gap));
    }
    // The value after a part `gone` of the stretch, with `left` remaining, times the fourth power of its
    // length.
    [[nodiscard]] HWY_INLINE V scaled_at(V gone, V left) const {
        const V first = mul_add(b0, left, all(4) * b1 * gone) * left * left * left;
        const V last = mul_add(b4, gone, all(4) * b3 * left) * gone * gone * gone;
        return first + last + all(6) * b2 * gone * gone * left * left;
    }
};
// The hull's margin for a stretch of this length.
HWY_INLINE V hull_margin(V fourth_derivative, V length) {
    const V square = length * length;
    return fourth_derivative * square * square * all(1.0 / 144);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
