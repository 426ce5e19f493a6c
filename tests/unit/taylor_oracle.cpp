#include "taylor_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peterka::testing {

TaylorOracle::TaylorOracle(const scene::Oscillator<double>& scene, const scene::State<double>& start)
    : zeta_(scene.damping_ratio),
      stiffness_(scene.kelvin_voigt().stiffness),
      damping_(scene.kelvin_voigt().damping),
      eta_(scene.frequency),
      gap_(scene.gap),
      cubic_(scene.cubic),
      cart_(scene.cubic_form == job::CubicForm::absolute ? 1 : 0),
      u_(Real(start[0]) + gap_),
      v_(start[1]),
      phase_(start[0] > 0 ? Phase::unloaded : Phase::flight) {
    if (phase_ == Phase::unloaded && force({u_, v_}) > 0) phase_ = Phase::contact;
}

void TaylorOracle::advance(int cycles) {
    peak_force_ = 0;
    impacts_ = 0;
    const Real period = 2 * std::numbers::pi_v<Real> / eta_;
    for (int n = 0; n < cycles; ++n) {
        time_ = 0;
        // a softening spring that gave way never ends its cycle
        while (time_ < period && std::abs(u_) < 1e6L) step(period - time_);
    }
}

// Coefficients of u(time_ + t), from u'' = eta^2 sin - u - 2 zeta u' - f - cubic ((u + y)^3 - y^3).
void TaylorOracle::expand() {
    std::array<Real, order + 1> y{};        // the cart
    std::array<Real, order + 1> x{};        // what the spring's cubic part sees
    std::array<Real, order + 1> squares{};  // x^2 and y^2
    std::array<Real, order + 1> cart_squares{};
    const bool presses = phase_ == Phase::contact;
    series_[0] = u_;
    series_[1] = v_;
    Real wave[2] = {std::sin(eta_ * time_), std::cos(eta_ * time_)};
    for (int n = 0; n + 2 <= order; ++n) {
        const auto i = static_cast<std::size_t>(n);
        y[i] = n % 4 < 2 ? wave[n % 2] : -wave[n % 2];
        x[i] = series_[i] + cart_ * y[i];
        Real cube = 0;
        for (std::size_t a = 0; a <= i; ++a) {
            squares[i] += x[a] * x[i - a];
            cart_squares[i] += y[a] * y[i - a];
        }
        for (std::size_t a = 0; a <= i; ++a) {
            cube += squares[a] * x[i - a] - cart_ * cart_squares[a] * y[i - a];
        }
        const Real slope = Real(n + 1) * series_[i + 1];
        Real acceleration = eta_ * eta_ * y[i] - series_[i] - 2 * zeta_ * slope - cubic_ * cube;
        if (presses) {
            acceleration -= stiffness_ * (series_[i] - (n == 0 ? gap_ : 0)) + damping_ * slope;
        }
        series_[i + 2] = acceleration / Real((n + 1) * (n + 2));
        wave[0] *= eta_ / Real(n + 1);
        wave[1] *= eta_ / Real(n + 1);
    }
}

TaylorOracle::Point TaylorOracle::at(Real t) const {
    Point p{0, 0};
    for (int n = order; n >= 0; --n) {
        p.v = p.v * t + p.u;
        p.u = p.u * t + series_[static_cast<std::size_t>(n)];
    }
    return p;
}

TaylorOracle::Real TaylorOracle::over(const Point& p) const {
    switch (phase_) {
        case Phase::flight:
            return p.u - gap_;
        case Phase::contact:
            return -force(p);
        case Phase::unloaded:
            break;
    }
    return std::max(gap_ - p.u, force(p));
}

void TaylorOracle::step(Real longest) {
    constexpr int samples = 16;
    const bool presses = phase_ == Phase::contact;
    const Real fastest = 1 + eta_ + (presses ? std::sqrt(stiffness_) + damping_ : 0);
    const Real length = std::min(longest, Real(0.5) / fastest);
    expand();
    Real end = length;
    bool event = false;
    // an event's own surface is where the phase begins: the first sample is past it
    for (int n = 1; n <= samples && !event; ++n) {
        const Real t = length * Real(n) / samples;
        if (over(at(t)) <= 0) continue;
        event = true;
        Real before = length * Real(n - 1) / samples;
        end = t;
        for (int halving = 0; halving < 70; ++halving) {
            const Real middle = (before + end) / 2;
            (over(at(middle)) > 0 ? end : before) = middle;
        }
    }
    if (presses) raise_peak(0, end);
    const Point p = at(end);
    u_ = p.u;
    v_ = p.v;
    time_ = end == longest ? 2 * std::numbers::pi_v<Real> / eta_ : time_ + end;
    if (event) finish_phase();
}

void TaylorOracle::finish_phase() {
    switch (phase_) {
        case Phase::flight:
            u_ = gap_;
            ++impacts_;
            phase_ = Phase::contact;
            return;
        case Phase::contact:
            phase_ = damping_ > 0 ? Phase::unloaded : Phase::flight;
            if (phase_ == Phase::flight) u_ = gap_;  // an elastic stop lets go where it was touched
            return;
        case Phase::unloaded:
            phase_ = u_ > gap_ ? Phase::contact : Phase::flight;
            return;
    }
}

// The force has at most one maximum within a step: it is convex towards it, and thirds close in on it.
void TaylorOracle::raise_peak(Real from, Real to) {
    peak_force_ = std::max({peak_force_, force(at(from)), force(at(to))});
    for (int n = 0; n < 120; ++n) {
        const Real third = (to - from) / 3;
        (force(at(from + third)) < force(at(to - third)) ? from : to) =
            force(at(from + third)) < force(at(to - third)) ? from + third : to - third;
    }
    peak_force_ = std::max(peak_force_, force(at(from)));
}

}  // namespace peterka::testing
