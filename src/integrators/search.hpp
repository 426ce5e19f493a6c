// Events within one step of an integrator: the first rise of a signal through zero, and its largest value.
//
// Between two samples of the trajectory the signal is the quintic Hermite interpolant of value, slope and
// curvature at both ends. Its Bernstein coefficients bound it, a margin covers the interpolation error, and
// intervals that the bounds cannot decide are halved and sampled again: hops and grazing maxima within a step
// cannot hide. Where the curvature is noise (in a stiff contact), the cubic through values and slopes replaces
// the quintic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace peterka::integrators {

struct Sample {
    double time;
    double value;
    double slope;
    double curvature;  // NaN: not known
};

// The signal between two samples, by Bernstein coefficients over the interval.
struct SignalCurve {
    std::array<double, 6> at{};
    double margin = 0;  // of the interpolation

    SignalCurve(const Sample& a, const Sample& b) {
        const double h = b.time - a.time;
        const double chord = (b.value - a.value) / h;
        // second derivatives of the cubic through values and slopes
        const double first = (6 * chord - 4 * a.slope - 2 * b.slope) / h;
        const double last = (2 * a.slope + 4 * b.slope - 6 * chord) / h;
        const bool known = std::isfinite(a.curvature) && std::isfinite(b.curvature);
        const double ca = known ? a.curvature : first;
        const double cb = known ? b.curvature : last;
        at = {a.value,
              a.value + h * a.slope / 5,
              a.value + 2 * h * a.slope / 5 + h * h * ca / 20,
              b.value - 2 * h * b.slope / 5 + h * h * cb / 20,
              b.value - h * b.slope / 5,
              b.value};
        // The cubic's error is about h^2/32 times the mismatch of curvatures. The quintic's is smaller by a
        // factor of (h w)^2/120 at the rate w of the signal; an integrator's steps keep h w below 1.5.
        margin = h * h / 32 * std::max(std::abs(ca - first), std::abs(cb - last)) / 50;
    }

    // An upper bound: the largest coefficient of degree 6, with the margin's bump in the middle.
    [[nodiscard]] double upper_bound() const {
        const double middle = (at[2] + at[3]) / 2 + 3.2 * margin;
        return std::max({at[0], (at[0] + 5 * at[1]) / 6, (at[1] + 2 * at[2]) / 3, middle,
                         (2 * at[3] + at[4]) / 3, (5 * at[4] + at[5]) / 6, at[5]});
    }
    [[nodiscard]] bool rises() const { return std::is_sorted(at.begin(), at.end()); }
    [[nodiscard]] bool is_concave() const {
        for (std::size_t i = 0; i + 2 < at.size(); ++i) {
            if (!(at[i] - 2 * at[i + 1] + at[i + 2] < 0)) return false;
        }
        return true;
    }
    [[nodiscard]] double value(double share) const { return casteljau(at, share); }
    [[nodiscard]] double slope(double share) const {  // up to a positive factor
        std::array<double, 5> difference{};
        for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = at[i + 1] - at[i];
        return casteljau(difference, share);
    }

  private:
    template <std::size_t n>
    static double casteljau(std::array<double, n> c, double share) {
        for (std::size_t level = n - 1; level > 0; --level) {
            for (std::size_t i = 0; i < level; ++i) c[i] += share * (c[i + 1] - c[i]);
        }
        return c[0];
    }
};

// Share of the interval at which a function with one change of sign has it.
template <class Function>
double sign_change(Function&& function, bool rising) {
    constexpr int halvings = 40;  // far below the accuracy of the curve itself
    double low = 0;
    double high = 1;
    for (int n = 0; n < halvings; ++n) {
        const double middle = (low + high) / 2;
        ((function(middle) > 0) == rising ? high : low) = middle;
    }
    return (low + high) / 2;
}

constexpr int deepest_look = 24;  // halvings of a step: 1e-7 of it, where any signal is a parabola
// Samples within a step; where it takes more, the signal is noise throughout.
constexpr int most_looks = 10'000;

struct Bracket {
    Sample below;
    Sample above;
};

// Where the signal first rises through zero between two samples, the first of which is not above zero;
// sample_at(time) gives a sample in between. Each counts `looks` down; at 0 the search has given up, unless it
// returns what it had found.
template <class SampleAt>
std::optional<Bracket> first_rise(const Sample& a, const Sample& b, SampleAt&& sample_at, int& looks,
                                  int depth = deepest_look) {
    const SignalCurve curve(a, b);
    if (curve.upper_bound() <= 0) return std::nullopt;
    if (b.value > 0 && (curve.rises() || depth == 0)) return Bracket{a, b};
    if (depth == 0 || looks <= 0) return std::nullopt;
    --looks;
    const Sample middle = sample_at((a.time + b.time) / 2);
    if (const auto early = first_rise(a, middle, sample_at, looks, depth - 1)) return early;
    return middle.value > 0 ? Bracket{a, middle} : first_rise(middle, b, sample_at, looks, depth - 1);
}

// The largest value between two samples, or `largest` where none exceeds it by more than this relative amount.
// `looks` as above.
template <class SampleAt>
double largest_between(const Sample& a, const Sample& b, SampleAt&& sample_at, double relative, double largest,
                       int& looks, int depth = deepest_look) {
    largest = std::max({largest, a.value, b.value});
    const SignalCurve curve(a, b);
    if (depth == 0 || looks <= 0 || curve.upper_bound() <= largest * (1 + relative)) return largest;
    if (curve.is_concave()) {
        if (a.slope <= 0 || b.slope >= 0) return largest;
        const double share = sign_change([&](double s) { return -curve.slope(s); }, true);
        --looks;
        const Sample top = sample_at(a.time + share * (b.time - a.time));
        // the curve's maximum is so close that the parabola's correction is exact
        const double correction = top.curvature < 0 ? top.slope * top.slope / (-2 * top.curvature) : 0;
        return std::max(largest, top.value + correction);
    }
    const Sample middle = sample_at((a.time + b.time) / 2);
    --looks;
    largest = largest_between(a, middle, sample_at, relative, largest, looks, depth - 1);
    return largest_between(middle, b, sample_at, relative, largest, looks, depth - 1);
}

}  // namespace peterka::integrators
