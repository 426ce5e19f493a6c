#include "certificate/ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peterka::certificate {
namespace {

constexpr slong bits_of_double = 53;
constexpr slong far = 1L << 28;  // as an exponent, beyond all that occur

class Bound {
  public:
    Bound() { arf_init(bound_); }
    Bound(const Bound&) = delete;
    Bound& operator=(const Bound&) = delete;
    Bound(Bound&&) = delete;
    Bound& operator=(Bound&&) = delete;
    ~Bound() { arf_clear(bound_); }
    [[nodiscard]] arf_ptr get() { return bound_; }
    [[nodiscard]] double below() const { return arf_get_d(bound_, ARF_RND_FLOOR); }
    [[nodiscard]] double above() const { return arf_get_d(bound_, ARF_RND_CEIL); }

  private:
    arf_t bound_;
};

template <class Function>
Ball result_of(Function&& function) {
    Ball result;
    function(result.get());
    return result;
}

}  // namespace

Ball::Ball(const Interval& x) : Ball() {
    if (!(x.lo <= x.hi)) {
        arb_indeterminate(ball_);
        return;
    }
    Bound low;
    Bound high;
    arf_set_d(low.get(), x.lo);
    arf_set_d(high.get(), x.hi);
    arb_set_interval_arf(ball_, low.get(), high.get(), bits());
}

double Ball::lowest() const {
    Bound bound;
    arb_get_lbound_arf(bound.get(), ball_, bits_of_double);
    return bound.below();
}
double Ball::highest() const {
    Bound bound;
    arb_get_ubound_arf(bound.get(), ball_, bits_of_double);
    return bound.above();
}
double Ball::size() const {
    Bound bound;
    arb_get_abs_ubound_arf(bound.get(), ball_, bits_of_double);
    return bound.above();
}
double Ball::radius() const {
    Bound bound;
    arf_set_mag(bound.get(), arb_radref(ball_));
    return bound.above();
}
double Ball::radius_over(slong exponent) const {
    Bound mantissa;
    fmpz_t own;
    fmpz_init(own);
    arf_set_mag(mantissa.get(), arb_radref(ball_));
    arf_frexp(mantissa.get(), own, mantissa.get());
    fmpz_clear(own);
    const slong shift = std::clamp<slong>(exponent_of_radius(), -far, far) - std::clamp(exponent, -far, far);
    return std::ldexp(mantissa.above(), static_cast<int>(shift)) + std::numeric_limits<double>::denorm_min();
}
slong Ball::exponent_of_radius() const {
    Bound bound;
    arf_set_mag(bound.get(), arb_radref(ball_));
    return arf_abs_bound_lt_2exp_si(bound.get());
}
Ball Ball::middle() const {
    return result_of([&](arb_ptr to) { arb_get_mid_arb(to, ball_); });
}
Interval Ball::hull() const {
    const Interval x{lowest(), highest()};
    return x.hi - x.lo < std::numeric_limits<double>::infinity() ? x : nothing();
}

Ball operator-(const Ball& a) {
    return result_of([&](arb_ptr to) { arb_neg(to, a.get()); });
}
Ball operator+(const Ball& a, const Ball& b) {
    return result_of([&](arb_ptr to) { arb_add(to, a.get(), b.get(), Ball::bits()); });
}
Ball operator-(const Ball& a, const Ball& b) {
    return result_of([&](arb_ptr to) { arb_sub(to, a.get(), b.get(), Ball::bits()); });
}
Ball operator*(const Ball& a, const Ball& b) {
    return result_of([&](arb_ptr to) { arb_mul(to, a.get(), b.get(), Ball::bits()); });
}
Ball operator/(const Ball& a, const Ball& b) {
    return result_of([&](arb_ptr to) { arb_div(to, a.get(), b.get(), Ball::bits()); });
}
Ball abs(const Ball& a) {
    return result_of([&](arb_ptr to) { arb_abs(to, a.get()); });
}
Ball square(const Ball& a) {
    return result_of([&](arb_ptr to) { arb_sqr(to, a.get(), Ball::bits()); });
}
Ball sqrt(const Ball& a) {
    return result_of([&](arb_ptr to) { arb_sqrt(to, a.get(), Ball::bits()); });
}
Ball exp(const Ball& a) {
    return result_of([&](arb_ptr to) { arb_exp(to, a.get(), Ball::bits()); });
}
SineCosineOf<Ball> sine_cosine(const Ball& angle) {
    SineCosineOf<Ball> result;
    arb_sin_cos(result.sine.get(), result.cosine.get(), angle.get(), Ball::bits());
    return result;
}
std::optional<Ball> common_part(const Ball& a, const Ball& b) {
    Ball result;
    if (arb_intersection(result.get(), a.get(), b.get(), Ball::bits()) == 0) return std::nullopt;
    return result;
}
Ball box_around(const Ball& middle, double radius) {
    Ball result = middle;
    Bound bound;
    arf_set_d(bound.get(), radius);
    arb_add_error_arf(result.get(), bound.get());
    return result;
}
Ball Constants<Ball>::pi() {
    return result_of([&](arb_ptr to) { arb_const_pi(to, Ball::bits()); });
}

}  // namespace peterka::certificate
