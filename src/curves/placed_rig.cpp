#include "curves/placed_rig.hpp"

#include <cmath>
#include <complex>

namespace peterka::curves {

namespace {

using Complex = std::complex<double>;

// The steady-state solution of a leg's equation at a time, and its derivatives by frequency and gap.
struct SteadyMotion {
    State<double> state;
    State<double> by_frequency;
    State<double> by_gap;
};

SteadyMotion steady_motion(double damping, double stiffness, const scene::Oscillator<double>& at, double time) {
    const double eta = at.frequency;
    const Complex impedance(stiffness - eta * eta, 2 * damping * eta);
    const Complex impedance_slope(-2 * eta, 2 * damping);
    const Complex response = eta * eta / impedance;
    const Complex response_slope = (2 * eta - response * impedance_slope) / impedance;
    const Complex turn(std::cos(eta * time), std::sin(eta * time));
    const Complex turn_rate(0, eta);
    const Complex change = (response_slope + Complex(0, time) * response) * turn;  // of the response, by eta
    return {{(response * turn).imag() - at.gap / stiffness, (turn_rate * response * turn).imag()},
            {change.imag(), (Complex(0, 1) * response * turn + turn_rate * change).imag()},
            {-1 / stiffness, 0}};
}

motion::LinearEquation<double> unforced(double damping, double stiffness) {
    return {.damping = damping, .stiffness = stiffness, .offset = 0, .drive = 0, .frequency = 1};
}

double kappa_of(const scene::Oscillator<double>& oscillator) {
    const auto* voigt = oscillator.spring_dashpot();
    return voigt == nullptr ? 0 : voigt->stiffness;
}

double chi_of(const scene::Oscillator<double>& oscillator) {
    const auto* voigt = oscillator.spring_dashpot();
    return voigt == nullptr ? 0 : voigt->damping;
}

}  // namespace

PlacedRig::PlacedRig(const scene::Oscillator<double>& oscillator, const PlaceSlopes& slopes)
    : oscillator_(scene::without_cubic(oscillator)),
      slopes_(slopes),
      rigid_(scene::is_rigid(oscillator.contact)),
      restitution_(rigid_ ? oscillator.restitution().coefficient : 0),
      kappa_(kappa_of(oscillator)),
      chi_(chi_of(oscillator)),
      contact_damping_(oscillator.damping_ratio + chi_ / 2),
      flight_(unforced(oscillator.damping_ratio, 1)),
      contact_(unforced(contact_damping_, 1 + kappa_)) {}

State<double> PlacedRig::slope(bool presses, double time, const State<double>& x) const {
    const double eta = oscillator_.frequency;
    return {x[1], eta * eta * std::sin(eta * time) - oscillator_.gap - 2 * damping(presses) * x[1] -
                      stiffness(presses) * x[0]};
}

Jacobian<double> PlacedRig::flow(bool presses, double length) const {
    return (presses ? contact_ : flight_).flow(length);
}

State<double> PlacedRig::state_in_leg(bool presses, double from, const State<double>& start, double to) const {
    const double b = damping(presses);
    const double w2 = stiffness(presses);
    return steady_motion(b, w2, oscillator_, to).state +
           flow(presses, to - from) * (start - steady_motion(b, w2, oscillator_, from).state);
}

LegEnd PlacedRig::leg(bool presses, double from, const State<double>& start, double to) const {
    const double b = damping(presses);
    const double w2 = stiffness(presses);
    const SteadyMotion here = steady_motion(b, w2, oscillator_, from);
    const SteadyMotion there = steady_motion(b, w2, oscillator_, to);
    LegEnd end;
    end.by_start = flow(presses, to - from);
    end.state = there.state + end.by_start * (start - here.state);
    end.by_start_time = -end.by_start * slope(presses, from, start);
    end.by_end_time = slope(presses, to, end.state);
    end.by_frequency = there.by_frequency - end.by_start * here.by_frequency;
    end.by_gap = there.by_gap - end.by_start * here.by_gap;
    return end;
}

Change PlacedRig::saltation(const Event& event, bool grazing_counts, double speed) const {
    Change change;
    const bool begins = event.kind == EventKind::touch || (event.kind == EventKind::graze && grazing_counts);
    if (!begins) return change;
    if (!rigid_) {
        change.value(1, 0) = -chi_;
        return change;
    }
    const double r = restitution_;
    const double v = event.velocity / speed;
    const double eta = oscillator_.frequency;
    const double sine = std::sin(eta * event.time);
    const double cosine = std::cos(eta * event.time);
    const double share = (1 + r) / speed;
    change.value << -r * v, 0, share * (eta * eta * sine - oscillator_.gap), -r * v;
    change.by_velocity << -r / speed, 0, 0, -r / speed;
    change.by_time(1, 0) = share * eta * eta * eta * cosine;
    change.by_frequency(1, 0) = share * (2 * eta * sine + eta * eta * event.time * cosine);
    change.by_gap(1, 0) = -share;
    return change;
}

}  // namespace peterka::curves
