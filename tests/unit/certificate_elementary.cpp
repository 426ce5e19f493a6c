// Enclosures of elementary functions against Arb, whose balls are rigorous too: at points of all magnitudes,
// and on intervals of all widths.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "certificate/elementary.hpp"
#include "certificate/versions.hpp"

namespace peterka::certificate {
namespace {

constexpr int points = 200'000;

// An Arb number with 150 bits.
class Oracle {
  public:
    Oracle() { arb_init(ball_); }
    explicit Oracle(double x) : Oracle() { arb_set_d(ball_, x); }
    Oracle(const Oracle&) = delete;
    Oracle& operator=(const Oracle&) = delete;
    Oracle(Oracle&&) = delete;
    Oracle& operator=(Oracle&&) = delete;
    ~Oracle() { arb_clear(ball_); }

    template <class Function>
    [[nodiscard]] bool lies_in(const Interval& x, Function function) const {
        const Oracle value;
        function(const_cast<arb_ptr>(value.ball_), ball_, 150);
        const Oracle lower(x.lo);
        const Oracle upper(x.hi);
        return arb_le(lower.ball_, value.ball_) != 0 && arb_le(value.ball_, upper.ball_) != 0;
    }

  private:
    arb_t ball_;
};

// Magnitudes from 2^-40 to the largest, log-uniform, of both signs.
class Arguments {
  public:
    explicit Arguments(double largest) : exponent_(-40, std::log2(largest)) {}
    double operator()() {
        const double size = std::exp2(exponent_(random_));
        return random_() % 2 == 0 ? size : -size;
    }
    // 0 ... 1
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  private:
    std::mt19937_64 random_{36};
    std::uniform_real_distribution<double> exponent_;
};

double relative_width(const Interval& x) {
    return (x.hi - x.lo) / std::abs(x.middle());
}

TEST(CertificateElementary, ExpEnclosesArbs) {
    Arguments arguments(699);
    for (int i = 0; i < points; ++i) {
        const double x = arguments();
        const Interval enclosure = exp(Interval(x));
        ASSERT_TRUE(Oracle(x).lies_in(enclosure, arb_exp)) << x;
        ASSERT_LT(relative_width(enclosure), 3e-15) << x;
    }
}

TEST(CertificateElementary, SineAndCosineEncloseArbs) {
    Arguments arguments(1e5);
    for (int i = 0; i < points; ++i) {
        const double x = arguments();
        const SineCosine enclosure = sine_cosine(Interval(x));
        ASSERT_TRUE(Oracle(x).lies_in(enclosure.sine, arb_sin)) << x;
        ASSERT_TRUE(Oracle(x).lies_in(enclosure.cosine, arb_cos)) << x;
        ASSERT_LT(enclosure.sine.hi - enclosure.sine.lo, 2e-15) << x;
        ASSERT_LT(enclosure.cosine.hi - enclosure.cosine.lo, 2e-15) << x;
    }
}

// Near multiples of pi/2 most digits cancel.
TEST(CertificateElementary, SineAndCosineNearRightAngles) {
    Arguments arguments(6e4);
    for (int i = 0; i < points; ++i) {
        const double x = std::nearbyint(arguments()) * 1.5707963267948966;
        const SineCosine enclosure = sine_cosine(Interval(x));
        ASSERT_TRUE(Oracle(x).lies_in(enclosure.sine, arb_sin)) << x;
        ASSERT_TRUE(Oracle(x).lies_in(enclosure.cosine, arb_cos)) << x;
    }
}

TEST(CertificateElementary, IntervalsHoldTheirPoints) {
    Arguments arguments(600);
    for (int i = 0; i < points; ++i) {
        const double x = arguments();
        const double width = std::exp2(-50 * arguments.share());
        const Interval wide = around(x, width);
        const double inside = x + (2 * arguments.share() - 1) * width;
        ASSERT_TRUE(wide.holds(inside));
        ASSERT_TRUE(Oracle(inside).lies_in(exp(wide), arb_exp)) << x;
        ASSERT_TRUE(Oracle(inside).lies_in(sine_cosine(wide).sine, arb_sin)) << x;
        ASSERT_TRUE(Oracle(inside).lies_in(sine_cosine(wide).cosine, arb_cos)) << x;
    }
}

TEST(CertificateElementary, PiIsBetweenItsBounds) {
    EXPECT_TRUE(Oracle().lies_in(pi, [](arb_t value, const arb_t, slong bits) { arb_const_pi(value, bits); }));
    EXPECT_EQ(pi.hi, std::nextafter(pi.lo, 4));
}

TEST(CertificateElementary, BeyondTheRangeNothingIsTold) {
    EXPECT_FALSE(exp(Interval(701)).holds(1));
    EXPECT_TRUE(std::isnan(exp(nothing()).lo));
    EXPECT_EQ(sine_cosine(Interval(1e6)).sine.lo, -1);
    EXPECT_EQ(sine_cosine(Interval(0, 3)).cosine.hi, 1);
    EXPECT_EQ(exp(Interval(-1000, 0)).lo, 0);
}

}  // namespace
}  // namespace peterka::certificate
