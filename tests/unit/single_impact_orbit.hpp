// A hammer's periodic orbit with one impact on a rigid stop, by formula.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "scene/oscillator.hpp"

namespace peterka::testing {

// One impact in n cycles, by formula: A = [[0, 1], [-1, -2 zeta]], E = exp(A T).
struct SingleImpactOrbit {
    double speed;                       // before the impact
    double phase;                       // of the forcing at the impact
    scene::State<double> at_phase_0;    // (delta, delta')
    scene::Jacobian<double> monodromy;  // from just before an impact to just before the next
    double fold;                        // the gap up to which it exists

    SingleImpactOrbit(double r, double eta, double gap, int n, double zeta = 0.02) {
        const double period = 2 * std::numbers::pi * n / eta;
        const double rate = std::sqrt(1 - zeta * zeta);
        const auto flow = [&](double t) {
            const double decay = std::exp(-zeta * t);
            const double s = decay * std::sin(rate * t) / rate;
            const double c = decay * std::cos(rate * t);
            return scene::Jacobian<double>{{c + zeta * s, s}, {-s, c - zeta * s}};
        };
        const scene::Jacobian<double> e = flow(period);
        const scene::Jacobian<double> inverse = (e - scene::Jacobian<double>::Identity()).inverse();
        const double alpha = (1 + r) * inverse(0, 1);
        const double beta = (1 + r) * inverse(1, 1);
        const double drive = eta * eta;
        const double p = drive / std::hypot(1 - drive, 2 * zeta * eta);
        const double a = alpha * alpha + (r + beta) * (r + beta) / drive;
        const double b = -alpha * gap;
        speed = (-b + std::sqrt(b * b - a * (gap * gap - p * p))) / a;
        fold = p * std::sqrt(1 + alpha * alpha * drive / ((r + beta) * (r + beta)));
        const double theta = std::atan2((gap - alpha * speed) / p, -(r + beta) * speed / (p * eta));
        const double lag = std::atan2(2 * zeta * eta, 1 - drive);
        phase = std::fmod(theta + lag + 4 * std::numbers::pi, 2 * std::numbers::pi);
        scene::Jacobian<double> saltation;
        saltation << -r, 0, (1 + r) * (drive * std::sin(phase) - gap) / speed, -r;
        monodromy = e * saltation;
        // on to the next phase 0
        const double time = (2 * std::numbers::pi - phase) / eta;
        const auto steady = [&](double angle) {
            return scene::State<double>(p * std::sin(angle), p * eta * std::cos(angle));
        };
        const scene::State<double> after(gap, -r * speed);
        at_phase_0 =
            flow(time) * (after - steady(theta)) + steady(theta + eta * time) - scene::State<double>(gap, 0);
    }
};

}  // namespace peterka::testing
