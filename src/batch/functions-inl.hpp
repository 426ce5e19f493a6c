// Vectorized sine, cosine, exponential and flow of a linear phase, accurate to about one ulp.
#if defined(PETERKA_BATCH_FUNCTIONS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_FUNCTIONS_INL_HPP
#undef PETERKA_BATCH_FUNCTIONS_INL_HPP
#else
#define PETERKA_BATCH_FUNCTIONS_INL_HPP
#endif

#include "batch/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

struct SineCosine {
    V sine, cosine;
};

// For |x| <= pi/4, by Taylor series.
HWY_INLINE SineCosine small_sine_cosine(V x) {
    const V z = x * x;
    V s = all(-1 / 1307674368000.0);
    V c = all(1 / 20922789888000.0);
    s = mul_add(s, z, all(1 / 6227020800.0));
    c = mul_add(c, z, all(-1 / 87178291200.0));
    s = mul_add(s, z, all(-1 / 39916800.0));
    c = mul_add(c, z, all(1 / 479001600.0));
    s = mul_add(s, z, all(1 / 362880.0));
    c = mul_add(c, z, all(-1 / 3628800.0));
    s = mul_add(s, z, all(-1 / 5040.0));
    c = mul_add(c, z, all(1 / 40320.0));
    s = mul_add(s, z, all(1 / 120.0));
    c = mul_add(c, z, all(-1 / 720.0));
    s = mul_add(s, z, all(-1 / 6.0));
    c = mul_add(c, z, all(1 / 24.0));
    c = mul_add(c, z, all(-0.5));
    return {mul_add(x * z, s, x), mul_add(c, z, all(1))};
}

// For |x| < 1e6, where the products with the parts of pi/2 are still exact.
HWY_INLINE SineCosine sine_cosine(V x) {
    const V quarters = round(x * all(0.63661977236758134308));
    V r = mul_add(quarters, all(-1.57079632673412561417), x);
    r = mul_add(quarters, all(-6.07710050630396597660e-11), r);
    r = mul_add(quarters, all(-2.02226624879595063154e-21), r);
    const SineCosine part = small_sine_cosine(r);
    const V halves = quarters * all(0.5);
    const V turns = floor(halves);
    const Mask odd = halves != turns;
    const Mask back = (turns * all(0.5)) != floor(turns * all(0.5));  // quarters 2 and 3 of four
    const V sine = choose(odd, part.cosine, part.sine);
    const V cosine = choose(odd, -part.sine, part.cosine);
    return {choose(back, -sine, sine), choose(back, -cosine, cosine)};
}

// x 2^n: n sits in the low bits of n + 1.5 2^52.
HWY_INLINE V scaled(V x, V n) {
    const V shifted = n + all(6755399441055744.0);
    const auto one = [](hn::Vec<Tag> number, hn::Vec<Tag> power) HWY_ATTR {
        const auto exponent = hn::ShiftLeft<52>(hn::BitCast(IndexTag(), power));
        return hn::BitCast(Tag(), hn::Add(hn::BitCast(IndexTag(), number), exponent));
    };
    return {one(x.a, shifted.a), one(x.b, shifted.b)};
}

constexpr double factorial(int n) {
    return n < 2 ? 1 : n * factorial(n - 1);
}
// The terms of exp(x) from x^first/first! to x^last/last!, over x^first.
template <int last, int first = 0>
HWY_INLINE V exp_series(V x) {
    const V coefficient = all(1 / factorial(first));
    if constexpr (first == last) {
        return coefficient;
    } else {
        return mul_add(exp_series<last, first + 1>(x), x, coefficient);
    }
}

// exp(x) for x <= 700; 0 below -700.
HWY_INLINE V exp_of(V x) {
    const V n = round(max(x, all(-700)) * all(1.44269504088896340736));
    V r = mul_add(n, all(-6.93147180369123816490e-01), max(x, all(-700)));
    r = mul_add(n, all(-1.90821492927058770002e-10), r);
    const V p = exp_series<13>(r);
    return choose(x > all(-700), scaled(p, n), all(0));
}

// For |x| <= 0.1, by Taylor series.
HWY_INLINE V small_exp(V x) {
    return exp_series<9>(x);
}

struct Matrix2 {
    V e00, e01, e10, e11;
    HWY_INLINE V upper(V x, V v) const { return mul_add(e00, x, e01 * v); }
    HWY_INLINE V lower(V x, V v) const { return mul_add(e10, x, e11 * v); }
};
HWY_INLINE Matrix2 operator*(const Matrix2& a, const Matrix2& b) {
    return {a.upper(b.e00, b.e10), a.upper(b.e01, b.e11), a.lower(b.e00, b.e10), a.lower(b.e01, b.e11)};
}
HWY_INLINE Matrix2 choose(Mask which, const Matrix2& yes, const Matrix2& no) {
    return {choose(which, yes.e00, no.e00), choose(which, yes.e01, no.e01), choose(which, yes.e10, no.e10),
            choose(which, yes.e11, no.e11)};
}
// Saltation matrix times m, where the velocity loses `slope` times the position.
HWY_INLINE Matrix2 kicked(const Matrix2& m, V slope) {
    return {m.e00, m.e01, neg_mul_add(slope, m.e00, m.e10), neg_mul_add(slope, m.e01, m.e11)};
}
HWY_INLINE Matrix2 load_jacobian(const Lanes& lanes, std::size_t from) {
    return {load(lanes.jacobian(0) + from), load(lanes.jacobian(1) + from), load(lanes.jacobian(2) + from),
            load(lanes.jacobian(3) + from)};
}
HWY_INLINE void store_jacobian(const Matrix2& m, const Lanes& lanes, std::size_t to) {
    store(m.e00, lanes.jacobian(0) + to);
    store(m.e01, lanes.jacobian(1) + to);
    store(m.e10, lanes.jacobian(2) + to);
    store(m.e11, lanes.jacobian(3) + to);
}
HWY_INLINE Matrix2 gather_jacobian(const Lanes& lanes, Index which) {
    return {gather(lanes.jacobian(0), which), gather(lanes.jacobian(1), which),
            gather(lanes.jacobian(2), which), gather(lanes.jacobian(3), which)};
}
HWY_INLINE void scatter_jacobian(const Matrix2& m, const Lanes& lanes, Index which) {
    scatter(m.e00, lanes.jacobian(0), which);
    scatter(m.e01, lanes.jacobian(1), which);
    scatter(m.e10, lanes.jacobian(2), which);
    scatter(m.e11, lanes.jacobian(3), which);
}

// (x, x') after t, from (1, 0) and (0, 1), of x'' + 2 decay x' + (rate^2 + decay^2) x = 0. shrunk: exp(-decay
// t).
HWY_INLINE Matrix2 flow(SineCosine turn, V shrunk, V decay, V square, V inverse_rate) {
    const V swing = shrunk * turn.cosine;
    const V e01 = shrunk * turn.sine * inverse_rate;
    return {mul_add(decay, e01, swing), e01, -square * e01, neg_mul_add(decay, e01, swing)};
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
