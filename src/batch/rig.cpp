#include "batch/rig.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "motion/linear_motion.hpp"

namespace peterka::batch {

namespace {

using Motion = motion::LinearMotion<double>;

Flow flow_of(const Motion& motion, double t) {
    const auto m = motion.flow(t);
    return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
}

// The unforced force after a unit speed, and its derivatives.
struct UnitForce {
    double value;
    double slope;
    double curvature;
};
UnitForce unit_force(const Rig& rig, const Motion& contact, double t) {
    const Flow flow = flow_of(contact, t);
    const double acceleration = -2 * rig.contact_decay * flow.e11 - rig.contact_square * flow.e01;
    const double jerk = -2 * rig.contact_decay * acceleration - rig.contact_square * flow.e11;
    return {rig.stiffness * flow.e01 + rig.damping * flow.e11,
            rig.stiffness * flow.e11 + rig.damping * acceleration,
            rig.stiffness * acceleration + rig.damping * jerk};
}

// Where the unforced force vanishes, and where its slope does.
void set_unforced_times(Rig& rig, const Motion& contact) {
    const double b = rig.contact_decay;
    const double rate = rig.contact_rate;
    // F = exp(-b t) (chi cos(rate t) + (kappa - b chi)/rate sin(rate t)), and its slope likewise
    const double k = rig.stiffness;
    const double chi = rig.damping;
    const double quadrature = (k - b * chi) / rate;
    rig.exit_time = std::atan2(chi, -quadrature) / rate;
    const double slope_cosine = rate * quadrature - b * chi;
    const double slope_sine = -rate * chi - b * quadrature;
    rig.peak_time = slope_cosine > 0 ? std::atan2(slope_cosine, -slope_sine) / rate : 0;
    rig.exit_flow = flow_of(contact, rig.exit_time);
    rig.peak_flow = flow_of(contact, rig.peak_time);
}

// A range of a/v and a bound of J/v.
struct ShareBounds {
    double least = -std::numeric_limits<double>::infinity();
    double largest = std::numeric_limits<double>::infinity();
    double jerk = std::numeric_limits<double>::infinity();

    [[nodiscard]] double width() const { return std::min(largest, -least); }
};

// The range narrowed to where first + (a/v) second + (J/v) remainder < 0; half of `first` is reserved for the
// remainder, and some for the error between samples.
ShareBounds narrowed(ShareBounds range, double first, double second, double remainder) {
    if (!(first < 0)) return {0, 0, 0};
    const double room = -0.45 * first;
    if (second > 0) range.largest = std::min(range.largest, room / second);
    if (second < 0) range.least = std::max(range.least, room / second);
    range.jerk = std::min(range.jerk, room / remainder);
    return range;
}

// Finds the time from which the force falls that gives the widest range of a/v.
void set_short_contacts(Rig& rig, const Motion& contact) {
    constexpr std::size_t samples = 512;
    // In unforced contact times: beyond about half a radian after the unforced exit, about which the kernel
    // expands, its series and Newton's method would no longer be accurate.
    constexpr double longest = 1.25;
    rig.latest_exit = longest * rig.exit_time;
    const double h = rig.latest_exit / samples;
    const auto time = [&](std::size_t n) { return h * static_cast<double>(n); };

    std::vector<UnitForce> force;
    std::vector<double> first_remainder;
    std::vector<double> second_remainder;
    double area_slope = 0;
    double area_curvature = 0;
    for (std::size_t n = 0; n <= samples; ++n) {
        const double t = time(n);
        force.push_back(unit_force(rig, contact, t));
        if (n > 0) {
            area_slope += h * std::max(std::abs(force[n].slope), std::abs(force[n - 1].slope));
            area_curvature += h * std::max(std::abs(force[n].curvature), std::abs(force[n - 1].curvature));
        }
        first_remainder.push_back(t * (rig.damping + area_slope));
        second_remainder.push_back(rig.damping + t * (std::abs(force[0].slope) + area_curvature));
    }
    std::vector<ShareBounds> falling(samples + 2);
    for (std::size_t n = samples + 1; n-- > 0;) {
        falling[n] = narrowed(falling[n + 1], force[n].slope, force[n].value, first_remainder[n]);
    }
    ShareBounds before;  // rising or concave at each sample up to here
    ShareBounds widest{0, 0, 0};
    for (std::size_t n = 0; n <= samples && time(n) < rig.exit_time; ++n) {
        const ShareBounds both{std::max(before.least, falling[n].least),
                               std::min(before.largest, falling[n].largest),
                               std::min(before.jerk, falling[n].jerk)};
        if (both.width() > widest.width()) {
            widest = both;
            rig.falls_from = time(n);
        }
        const ShareBounds rising = narrowed(before, -force[n].slope, -force[n].value, first_remainder[n]);
        const ShareBounds concave = narrowed(before, force[n].curvature, force[n].slope, second_remainder[n]);
        before = rising.width() > concave.width() ? rising : concave;
    }
    if (!(widest.width() > 0)) return;
    rig.least_pull = widest.least;
    rig.largest_pull = widest.largest;
    rig.largest_jerk = widest.jerk;
}

// The time near `guess` at which the force after a unit speed under a constant acceleration, f + a integral f,
// vanishes (order 0), or its slope (order 1). NaN if Newton's method does not converge.
double time_under(const Rig& rig, const Motion& contact, double a, int order, double guess) {
    double t = guess;
    for (int n = 0; n < 30; ++n) {
        const UnitForce f = unit_force(rig, contact, t);
        const Flow flow = flow_of(contact, t);
        const double area = rig.stiffness * (1 - flow.e00) / rig.contact_square + rig.damping * flow.e01;
        const double value = order == 0 ? f.value + a * area : f.slope + a * f.value;
        const double slope = order == 0 ? f.slope + a * f.value : f.curvature + a * f.slope;
        const double step = value / slope;
        t -= step;
        if (!(std::abs(t) < 2 * rig.exit_time)) break;
        if (std::abs(step) < 1e-12 * rig.exit_time) return t;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

// The polynomial in a/pull_scale that interpolates the shifts at the Chebyshev nodes.
std::array<double, Rig::guess_terms> fitted_shift(const Rig& rig, const Motion& contact, int order,
                                                  double unforced) {
    constexpr auto terms = static_cast<int>(Rig::guess_terms);
    Eigen::Matrix<double, terms, terms> powers;
    Eigen::Matrix<double, terms, 1> shifts;
    for (int n = 0; n < terms; ++n) {
        const double x = std::cos((n + 0.5) * std::numbers::pi / terms);
        shifts[n] = time_under(rig, contact, rig.pull_scale * x, order, unforced) - unforced;
        for (int k = 0; k < terms; ++k) powers(n, k) = std::pow(x, k);
    }
    const Eigen::Matrix<double, terms, 1> solution = powers.partialPivLu().solve(shifts);
    std::array<double, Rig::guess_terms> coefficients{};
    if (solution.allFinite()) std::copy_n(solution.data(), Rig::guess_terms, coefficients.begin());
    return coefficients;
}

void set_series(Rig& rig) {
    double before = 0;
    double coefficient = 1;
    rig.slope_series[0] = 1;
    for (std::size_t n = 1; n < Rig::series_length; ++n) {
        rig.series[n] = coefficient;
        const auto order = static_cast<double>(n);
        const double after = (-2 * rig.contact_decay * order * coefficient - rig.contact_square * before) /
                             (order * (order + 1));
        rig.slope_series[n] = (order + 1) * after;
        before = coefficient;
        coefficient = after;
    }
}

}  // namespace

Rig::Rig(const scene::Oscillator<double>& oscillator)
    : rigid(scene::is_rigid(oscillator.contact)),
      damping_ratio(oscillator.damping_ratio),
      cubic(oscillator.cubic) {
    const auto oscillates = [](const Motion& m) { return m.oscillates() && !m.near_critical(); };
    const Motion flight(motion::flight_equation(oscillator));
    weakly_damped = damping_ratio * 6 * std::numbers::pi / 4 < 0.1;
    flight_rate = flight.rate();
    if (rigid) {
        restitution = oscillator.restitution().coefficient;
        fit = oscillates(flight);
        return;
    }
    stiffness = oscillator.kelvin_voigt().stiffness;
    damping = oscillator.kelvin_voigt().damping;
    lag = damping / stiffness;
    const Motion contact(motion::contact_equation(oscillator));
    contact_decay = contact.equation().damping;
    contact_square = contact.equation().stiffness;
    contact_frequency = contact.natural_frequency();
    contact_rate = contact.rate();
    fit = oscillates(flight) && oscillates(contact) && stiffness > 0;
    if (!fit) return;
    set_unforced_times(*this, contact);
    set_short_contacts(*this, contact);
    set_series(*this);
    pull_scale = std::max(std::min(largest_pull, -least_pull), 1.0);
    const auto reached = [&](double a) {
        const double t = time_under(*this, contact, a, 0, exit_time);
        return t > falls_from && t < latest_exit;
    };
    while (pull_scale > 1 && !(reached(pull_scale) && reached(-pull_scale))) pull_scale *= 0.9;
    exit_shift = fitted_shift(*this, contact, 0, exit_time);
    peak_shift = fitted_shift(*this, contact, 1, peak_time);
}

}  // namespace peterka::batch
