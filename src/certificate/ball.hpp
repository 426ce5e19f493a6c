// Real numbers as balls with a midpoint of many bits, by Arb (F. Johansson, Arb: efficient arbitrary-precision
// midpoint-radius interval arithmetic, IEEE Transactions on Computers 66, 2017): for ways so sensitive that
// doubles don't carry them. The same templates serve them as intervals of doubles.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "certificate/course.hpp"
#include "certificate/interval.hpp"
#include "certificate/versions.hpp"

namespace peterka::certificate {

class Ball {
  public:
    // Bits of the results of operations, until the end of the scope.
    class Precision {
      public:
        explicit Precision(slong bits) : before_(std::exchange(bits_, bits)) {}
        Precision(const Precision&) = delete;
        Precision& operator=(const Precision&) = delete;
        Precision(Precision&&) = delete;
        Precision& operator=(Precision&&) = delete;
        ~Precision() { bits_ = before_; }

      private:
        slong before_;
    };
    [[nodiscard]] static slong bits() { return bits_; }

    Ball() { arb_init(ball_); }
    Ball(double exact) : Ball() { arb_set_d(ball_, exact); }  // NOLINT: a double is a number
    explicit Ball(const Interval& x);
    Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
    Ball(Ball&& other) noexcept : Ball() { arb_swap(ball_, other.ball_); }
    Ball& operator=(const Ball& other) {
        arb_set(ball_, other.ball_);
        return *this;
    }
    Ball& operator=(Ball&& other) noexcept {
        arb_swap(ball_, other.ball_);
        return *this;
    }
    ~Ball() { arb_clear(ball_); }

    [[nodiscard]] arb_srcptr get() const { return ball_; }
    [[nodiscard]] arb_ptr get() { return ball_; }

    [[nodiscard]] double lowest() const;                     // at or below all of it
    [[nodiscard]] double highest() const;                    // at or above all of it
    [[nodiscard]] double size() const;                       // at or above the largest |x|
    [[nodiscard]] double radius() const;                     // at or above it
    [[nodiscard]] double radius_over(slong exponent) const;  // at or above it over 2^exponent
    [[nodiscard]] slong exponent_of_radius() const;          // it is below 2^this
    [[nodiscard]] Ball middle() const;
    [[nodiscard]] bool positive() const { return arb_is_positive(ball_) != 0; }
    [[nodiscard]] Interval hull() const;  // in doubles

  private:
    static inline slong bits_ = 448;
    arb_t ball_;
};

Ball operator-(const Ball& a);
Ball operator+(const Ball& a, const Ball& b);
Ball operator-(const Ball& a, const Ball& b);
Ball operator*(const Ball& a, const Ball& b);
Ball operator/(const Ball& a, const Ball& b);
Ball abs(const Ball& a);
Ball square(const Ball& a);
Ball sqrt(const Ball& a);
Ball exp(const Ball& a);
SineCosineOf<Ball> sine_cosine(const Ball& angle);
// nothing where they have none.
std::optional<Ball> common_part(const Ball& a, const Ball& b);

// What the templates ask of a number.
inline bool surely_positive(const Ball& x) {
    return x.positive();
}
inline double size_of(const Ball& x) {
    return x.size();
}
inline double lowest(const Ball& x) {
    return x.lowest();
}
inline double highest(const Ball& x) {
    return x.highest();
}
inline Ball point_of(const Ball& x) {
    return x.middle();
}
inline double spread_of(const Ball& x, const Ball& point) {
    return (x - point).size();
}
Ball box_around(const Ball& middle, double radius);
inline Ball plus_minus(double bound, const Ball& /*like*/) {
    return box_around(Ball(0), bound);
}
inline Ball span_of(const Ball& angle, double more) {
    return angle + Ball(Interval(0, more));
}
inline bool is_small(const Ball& /*x*/) {
    return false;
}
template <std::size_t terms>
Ball coefficient_of_product(const std::array<Ball, terms>& a, const std::array<Ball, terms>& b, std::size_t n) {
    static_assert(sizeof(Ball) == sizeof(arb_struct));
    Ball sum;
    arb_dot(sum.get(), nullptr, 0, a[0].get(), 1, b[n].get(), -1, static_cast<slong>(n + 1), Ball::bits());
    return sum;
}
template <>
inline constexpr std::size_t taylor_order<Ball> = 90;
template <>
struct Constants<Ball> {
    static Ball pi();
};

}  // namespace peterka::certificate
