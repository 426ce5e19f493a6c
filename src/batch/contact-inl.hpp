// Contact of a vector of lanes, in closed form.
//
//     delta'' + 2 b delta' + w2 (delta - static_position) = eta^2 sin(theta),   F = kappa delta + chi delta'
//
// with w2 = 1 + kappa and static_position = -gap/w2 without a cubic spring.
#if defined(PETERKA_BATCH_CONTACT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_CONTACT_INL_HPP
#undef PETERKA_BATCH_CONTACT_INL_HPP
#else
#define PETERKA_BATCH_CONTACT_INL_HPP
#endif

#include "batch/flight-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The force and its derivatives.
struct Force {
    V value, slope, curvature, jerk, snap;
};

// A point of a contact: its homogeneous part, kept separately because the force would suffer cancellation
// otherwise, and the forcing's phase.
struct ContactPoint {
    V x, v, sine, cosine;
};

// cubic: with a cubic spring; such a contact is followed for at most one grid step.
template <bool cubic, class Cells>
class ContactOf {
  public:
    using Point = ContactPoint;

    HWY_INLINE ContactOf(const Lanes& lanes, const Cells& cells, const Moments& start)
        : cells_(cells),
          start_(start),
          re_(gather(lanes[Field::contact_re], cells.index)),
          im_(gather(lanes[Field::contact_im], cells.index)),
          static_position_(cells.contact_static_position),
          x_(start.delta - static_position_ - mul_add(re_, start.sine, im_ * start.cosine)),
          v_(start.velocity - cells.eta * mul_sub(re_, start.cosine, im_ * start.sine)),
          force_re_(mul_sub(all(cells.rig.stiffness), re_, all(cells.rig.damping) * cells.eta * im_)),
          force_im_(mul_add(all(cells.rig.stiffness), im_, all(cells.rig.damping) * cells.eta * re_)) {}

    [[nodiscard]] HWY_INLINE Point start() const { return {x_, v_, start_.sine, start_.cosine}; }
    [[nodiscard]] HWY_INLINE Point at(V t) const {
        const V angle = cells_.eta * t;
        return carried(flow_for(t), cubic ? small_sine_cosine(angle) : sine_cosine(angle));
    }
    [[nodiscard]] HWY_INLINE Matrix2 flow_for(V t) const {
        return flow(sine_cosine(cells_.contact_rate * t), exp_of(all(-cells_.rig.contact_decay) * t),
                    all(cells_.rig.contact_decay), cells_.contact_square, cells_.inverse_contact_rate);
    }

    [[nodiscard]] HWY_INLINE Force force(const Point& p) const {
        const V b = all(-2 * cells_.rig.contact_decay);
        const V square = cells_.contact_square;
        const V own = mul_add(all(cells_.rig.stiffness), p.x, all(cells_.rig.damping) * p.v);
        const V a = mul_sub(b, p.v, square * p.x);
        const V own_slope = mul_add(all(cells_.rig.stiffness), p.v, all(cells_.rig.damping) * a);
        const V own_curvature = mul_sub(b, own_slope, square * own);
        const V own_jerk = mul_sub(b, own_curvature, square * own_slope);
        const V forced = mul_add(force_re_, p.sine, force_im_ * p.cosine);
        const V forced_slope = cells_.eta * mul_sub(force_re_, p.cosine, force_im_ * p.sine);
        return {own + forced + all(cells_.rig.stiffness) * static_position_, own_slope + forced_slope,
                neg_mul_add(cells_.drive, forced, own_curvature),
                neg_mul_add(cells_.drive, forced_slope, own_jerk),
                mul_sub(b, own_jerk, square * own_curvature)};  // the forcing's part is negligible
    }
    [[nodiscard]] HWY_INLINE Moments moment(const Point& p) const {
        const V steady = mul_add(re_, p.sine, im_ * p.cosine);
        const V steady_velocity = cells_.eta * mul_sub(re_, p.cosine, im_ * p.sine);
        return {p.x + steady + static_position_, p.v + steady_velocity, p.sine, p.cosine};
    }

    [[nodiscard]] HWY_INLINE V static_position() const { return static_position_; }
    [[nodiscard]] HWY_INLINE V static_force() const { return all(cells_.rig.stiffness) * static_position_; }
    [[nodiscard]] HWY_INLINE V force_swing() const {
        return sqrt(mul_add(force_re_, force_re_, force_im_ * force_im_));
    }
    // Amplitudes of the homogeneous parts of the force and of the position, which only decay.
    [[nodiscard]] HWY_INLINE V force_amplitude(const Point& p) const {
        const V own = mul_add(all(cells_.rig.stiffness), p.x, all(cells_.rig.damping) * p.v);
        const V a = mul_sub(all(-2 * cells_.rig.contact_decay), p.v, cells_.contact_square * p.x);
        const V slope = mul_add(all(cells_.rig.stiffness), p.v, all(cells_.rig.damping) * a);
        const V quadrature = mul_add(all(cells_.rig.contact_decay), own, slope) * cells_.inverse_contact_rate;
        return sqrt(mul_add(own, own, quadrature * quadrature));
    }
    [[nodiscard]] HWY_INLINE V amplitude(const Point& p) const {
        const V quadrature = mul_add(all(cells_.rig.contact_decay), p.x, p.v) * cells_.inverse_contact_rate;
        return sqrt(mul_add(p.x, p.x, quadrature * quadrature));
    }

    // A short time t after one of the rig's own times, whose flow is known, by the rig's series; a cell with a
    // cubic spring has its own flow.
    [[nodiscard]] HWY_INLINE Point near(double time, const Flow& until, V t) const {
        if constexpr (cubic) return at(all(time) + t);
        constexpr std::size_t last = Rig::series_length - 1;
        V sine = all(cells_.rig.series[last]);
        V slope = all(cells_.rig.slope_series[last]);
        for (std::size_t n = last; n-- > 0;) {
            sine = mul_add(sine, t, all(cells_.rig.series[n]));
            slope = mul_add(slope, t, all(cells_.rig.slope_series[n]));
        }
        const Matrix2 after{mul_add(all(2 * cells_.rig.contact_decay), sine, slope), sine,
                            all(-cells_.rig.contact_square) * sine, slope};
        const V x = mul_add(all(until.e00), x_, all(until.e01) * v_);
        const V v = mul_add(all(until.e10), x_, all(until.e11) * v_);
        const SineCosine phase =
            turned(start_.sine, start_.cosine, small_sine_cosine(cells_.eta * (all(time) + t)));
        return {after.upper(x, v), after.lower(x, v), phase.sine, phase.cosine};
    }
    // A tiny time after p, by Taylor series.
    [[nodiscard]] HWY_INLINE Point next(const Point& p, V t) const {
        const V b = all(-2 * cells_.rig.contact_decay);
        const V square = cells_.contact_square;
        const V second = mul_sub(b, p.v, square * p.x);
        const V third = mul_sub(b, second, square * p.v);
        const V fourth = mul_sub(b, third, square * second);
        const V x3 = mul_add(t, fourth * all(1.0 / 24), third * all(1.0 / 6));
        const V v3 = mul_add(t, fourth * all(1.0 / 6), third * all(0.5));
        const V angle = cells_.eta * t;
        const V z = angle * angle;
        const V sine = angle * mul_add(z, all(-1.0 / 6), all(1));
        const V cosine = mul_add(z, mul_add(z, all(1.0 / 24), all(-0.5)), all(1));
        const SineCosine phase = turned(p.sine, p.cosine, {sine, cosine});
        return {mul_add(t, mul_add(t, mul_add(t, x3, second * all(0.5)), p.v), p.x),
                mul_add(t, mul_add(t, v3, second), p.v), phase.sine, phase.cosine};
    }

  private:
    [[nodiscard]] HWY_INLINE Point carried(const Matrix2& f, SineCosine forcing) const {
        const SineCosine phase = turned(start_.sine, start_.cosine, forcing);
        return {f.upper(x_, v_), f.lower(x_, v_), phase.sine, phase.cosine};
    }

    const Cells& cells_;
    const Moments& start_;
    V re_, im_;  // steady response
    V static_position_;
    V x_, v_;                // homogeneous part at the start
    V force_re_, force_im_;  // steady response of the force
};

// Zero of value + slope t + curvature t^2/2 + jerk t^3/6 + snap t^4/24 near t = 0; more accurate the closer it
// is.
struct Root {
    V time;
    V reach;  // at least |time|, and at least the step by the linear part alone
};
HWY_INLINE Root taylor_root(V value, V slope, V curvature, V jerk, V snap) {
    const V inverse = all(1) / slope;
    const V first = -value * inverse;
    const V second = curvature * inverse * all(0.5);
    const V third = jerk * inverse * all(1.0 / 6);
    const V fourth = snap * inverse * all(1.0 / 24);
    V t = first;
    for (int n = 0; n < 3; ++n) t = neg_mul_add(t * t, mul_add(mul_add(fourth, t, third), t, second), first);
    return {t, max(abs(t), abs(first))};
}

HWY_INLINE ContactPoint choose(Mask which, const ContactPoint& yes, const ContactPoint& no) {
    return {choose(which, yes.x, no.x), choose(which, yes.v, no.v), choose(which, yes.sine, no.sine),
            choose(which, yes.cosine, no.cosine)};
}

HWY_INLINE Force choose(Mask which, const Force& yes, const Force& no) {
    return {choose(which, yes.value, no.value), choose(which, yes.slope, no.slope),
            choose(which, yes.curvature, no.curvature), choose(which, yes.jerk, no.jerk),
            choose(which, yes.snap, no.snap)};
}

struct Peak {
    V force;
    Mask sure;
};

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
