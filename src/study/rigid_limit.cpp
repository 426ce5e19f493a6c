#include "study/rigid_limit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

#include "regime/steady_state.hpp"

namespace peterka::study {

double RigidLimit::restitution() const {
    const double zeta = contact_damping_ratio;
    return std::exp(-2 * zeta * std::acos(zeta) / std::sqrt(1 - zeta * zeta));
}

// The larger root V of (alpha^2 + (r + beta)^2/eta^2) V^2 - 2 alpha g V + g^2 - P^2 = 0, where alpha and beta
// are (1 + r) times the second column of (exp(A T) - I)^-1, A = [[0, 1], [-1, -2 zeta]], and P is the amplitude
// without a stop.
double RigidLimit::rigid_speed() const {
    const double r = restitution();
    const double zeta = damping_ratio;
    const double rate = std::sqrt(1 - zeta * zeta);
    const double time = 2 * std::numbers::pi / frequency;
    const double decay = std::exp(-zeta * time);
    const double sine = std::sin(rate * time) / rate;
    const double cosine = std::cos(rate * time);
    Eigen::Matrix2d flow;
    flow << decay * (cosine + zeta * sine), decay * sine, -decay * sine, decay * (cosine - zeta * sine);
    const Eigen::Matrix2d inverse = (flow - Eigen::Matrix2d::Identity()).inverse();
    const double alpha = (1 + r) * inverse(0, 1);
    const double beta = (1 + r) * inverse(1, 1);
    const double reach = frequency * frequency / std::hypot(1 - frequency * frequency, 2 * zeta * frequency);
    const double a = alpha * alpha + (r + beta) * (r + beta) / (frequency * frequency);
    const double half_b = -alpha * gap;
    const double c = gap * gap - reach * reach;
    return (-half_b + std::sqrt(half_b * half_b - a * c)) / a;
}

double RigidLimit::compliant_speed(double stiffness) const {
    const scene::Oscillator<double> oscillator{
        .damping_ratio = damping_ratio,
        .contact = scene::KelvinVoigt<double>{stiffness, 2 * contact_damping_ratio * std::sqrt(stiffness)},
        .frequency = frequency,
        .gap = gap};
    const scene::State<double> start(-1 - gap, 0);
    const auto result =
        regime::find_steady_state(oscillator, start, {}, {}, {.detail = trajectory::Detail::contacts});
    const bool one_to_one =
        result.regime == regime::Regime::periodic && result.impacts == 1 && result.period == 1;
    return one_to_one ? result.impact_speed : std::numeric_limits<double>::quiet_NaN();
}

double rung_stiffness(std::int64_t rung) {
    return std::pow(10.0, static_cast<double>(rung + 2));
}

}  // namespace peterka::study
