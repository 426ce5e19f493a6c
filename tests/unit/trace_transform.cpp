// The Fourier integral of a pulse whose phase angles are all exact.
#include "trace/transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "trace/spectrum.hpp"

namespace peterka::trace {
namespace {

// An impact on a rigid stop: one impulse. Its phase increment between lines is a sum of powers of two, so
// that w t is exact; only errors of the rotations remain, which would accumulate over all lines.
TEST(Transform, ErrorsOfTurningDoNotAddUpOverTheLines) {
    const scene::Oscillator<double> oscillator{
        .contact = scene::Restitution<double>{0.5}, .frequency = 1, .gap = 2};
    constexpr double step = 0.125;
    constexpr double time = 1.5;
    Transform transform(oscillator, 0, 5, step, most_lines);
    transform.stretch(Phase::flight, 0, time, [](double) { return State<double>(-1, 0); });
    transform.touch(2);
    const double impulse = 1.5 * 2;
    double largest = 0;
    for (std::int64_t n = 0; n < most_lines; ++n) {
        const long double angle = static_cast<long double>(n) * step * time;
        const std::complex<double> difference =
            transform.lines()[static_cast<std::size_t>(n)].force -
            std::complex<double>(static_cast<double>(impulse * std::cos(angle)),
                                 static_cast<double>(-impulse * std::sin(angle)));
        largest = std::max(largest, std::abs(difference));
    }
    EXPECT_LT(largest, 64 * 2e-16 * impulse);
}

}  // namespace
}  // namespace peterka::trace
