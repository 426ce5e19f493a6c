// Interval operations against long doubles, whose 64 bits show on which side of a double a result lies.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "certificate/interval.hpp"

namespace peterka::certificate {
namespace {

constexpr int pairs = 300'000;
using Long = long double;

class Numbers {
  public:
    double operator()() {
        const double size = std::exp2(exponent_(random_)) * mantissa_(random_);
        return random_() % 2 == 0 ? size : -size;
    }

  private:
    std::mt19937_64 random_{1969};
    std::uniform_real_distribution<double> exponent_{-300, 300};
    std::uniform_real_distribution<double> mantissa_{1, 2};
};

void expect_tight(const Interval& x, Long exact) {
    ASSERT_LT(x.lo, exact);
    ASSERT_GT(x.hi, exact);
    ASSERT_LE(x.hi - x.lo, 5e-16 * std::abs(static_cast<double>(exact)));
}

TEST(CertificateInterval, BoundsLieBeyondTheNeighbours) {
    Numbers numbers;
    for (int i = 0; i < pairs; ++i) {
        const double x = numbers();
        ASSERT_LE(down(x), std::nextafter(x, -INFINITY));
        ASSERT_GE(up(x), std::nextafter(x, INFINITY));
    }
    for (const double x : {0.0, 5e-324, -5e-324, 1e-310, 2.2250738585072014e-308, 1.0, -1.0}) {
        EXPECT_LE(down(x), std::nextafter(x, -INFINITY)) << x;
        EXPECT_GE(up(x), std::nextafter(x, INFINITY)) << x;
    }
}

TEST(CertificateInterval, OperationsEncloseWhatLongDoublesGive) {
    Numbers numbers;
    for (int i = 0; i < pairs; ++i) {
        const double a = numbers();
        const double b = a * std::exp2(static_cast<double>(i % 60) - 30) * 1.1;
        expect_tight(Interval(a) * Interval(0.7), Long(a) * 0.7L + Long(a) * (Long(0.7) - 0.7L));
        expect_tight(Interval(a) / Interval(b), Long(a) / Long(b));
        expect_tight(Interval(std::abs(a)) + Interval(std::abs(b)), std::abs(Long(a)) + std::abs(Long(b)));
        expect_tight(sqrt(Interval(std::abs(a))), std::sqrt(std::abs(Long(a))));
    }
}

TEST(CertificateInterval, ProductsOfAnySignsHoldThoseOfTheirPoints) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> bound(-3, 3);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < pairs; ++i) {
        const double p = bound(random);
        const double q = bound(random);
        const Interval a{std::min(p, q), std::max(p, q)};
        const double r = bound(random);
        const double s = bound(random);
        const Interval b{std::min(r, s), std::max(r, s)};
        const double x = std::clamp(a.lo + share(random) * (a.hi - a.lo), a.lo, a.hi);
        const double y = std::clamp(b.lo + share(random) * (b.hi - b.lo), b.lo, b.hi);
        ASSERT_TRUE((a * b).holds(x * y));
        ASSERT_TRUE((a - b).holds(x - y));
        ASSERT_TRUE(square(a).holds(x * x));
        ASSERT_TRUE(abs(a).holds(std::abs(x)));
        ASSERT_TRUE(larger(a, b).holds(std::max(x, y)));
        ASSERT_TRUE(hull(a, b).holds(x));
        if (b.positive() || b.negative()) {
            ASSERT_TRUE((a / b).holds(x / y));
        }
    }
}

// Operands that cannot be enclosed must answer every predicate with no, through any further operations.
TEST(CertificateInterval, NothingIsProvedOfNothing) {
    const Interval beyond = Interval(1e308) * Interval(10);
    const Interval by_zero = Interval(1) / Interval(-1, 1);
    const Interval root = sqrt(Interval(-2, 1));
    for (const Interval& x :
         {beyond, by_zero, root, beyond - beyond, by_zero * Interval(0), abs(root), square(by_zero),
          hull(Interval(1), root), larger(by_zero, Interval(2)), sqrt(beyond)}) {
        EXPECT_FALSE(x.positive());
        EXPECT_FALSE(x.negative());
        EXPECT_FALSE(x.holds(0));
        EXPECT_FALSE(x.inside({-1e308, 1e308}));
        EXPECT_FALSE(x.apart(Interval(3)));
        EXPECT_FALSE((x * x + Interval(5)).positive());
    }
}

}  // namespace
}  // namespace peterka::certificate
