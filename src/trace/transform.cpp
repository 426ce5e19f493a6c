#include "trace/transform.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "support/stop_request.hpp"
#include "trajectory/contact_rates.hpp"
#include "trajectory/leg_integrals.hpp"

namespace peterka::trace {

Transform::Transform(const scene::Oscillator<double>& oscillator, double from, double to, double step,
                     std::int64_t lines)
    : oscillator_(oscillator), from_(from), to_(to), step_(step), lines_(static_cast<std::size_t>(lines)) {}

void Transform::touch(double speed) {
    if (!scene::is_rigid(oscillator_.contact) || now() < from_ || !(now() < to_)) return;
    const double impulse = (1 + oscillator_.restitution().coefficient) * speed;
    add({now() - from_, impulse, -impulse});
}

void Transform::look(const Stretch& stretch) {
    const double begin = std::max(from_ - stretch.begin, 0.0);
    const double end = std::min(to_ - stretch.begin, stretch.length);
    if (!(end > begin)) return;
    const bool rigid = scene::is_rigid(oscillator_.contact);
    constexpr double most_pieces =
        10'000;  // for the contact's own rate: in a stiffer one its first part is enough
    const double largest_frequency = step_ * static_cast<double>(lines_.size());
    double rate = std::max({largest_frequency / 2, oscillator_.frequency, 1.0});
    if (stretch.phase == Phase::contact && !rigid) {
        const State<double> deepest = stretch.state_at(stretch.length / 2);
        const double own = trajectory::rates_of(trajectory::linearized_contact(oscillator_, deepest)).fast;
        rate = std::max(rate, std::min(own, most_pieces / (end - begin)));
    }
    const double pieces = std::ceil((end - begin) * rate);
    const double length = (end - begin) / pieces;
    for (double piece = 0; piece < pieces; ++piece) {
        stop_if_asked();
        add_piece(stretch, begin + piece * length, length);
    }
}

void Transform::add_piece(const Stretch& stretch, double begin, double length) {
    namespace rule = trajectory::gauss_legendre;
    const auto add_value = [&](double time, double weight) {
        const double in_cycle = stretch.from + time;
        const Quantities q = quantities(oscillator_, {stretch.begin + time, oscillator_.frequency * in_cycle,
                                                      stretch.state_at(time), stretch.phase});
        add({stretch.begin + time - from_, weight * q.force, weight * q.acceleration});
    };
    const double half = length / 2;
    for (std::size_t i = 0; i < rule::node.size(); ++i) {
        const double offset = half * static_cast<double>(rule::node[i]);
        const double weight = half * static_cast<double>(rule::weight[i]);
        add_value(begin + half - offset, weight);
        add_value(begin + half + offset, weight);
    }
}

// A node turns by the same angle from line to line; it is recomputed periodically, as rounding errors add up.
void Transform::add(const Node& node) {
    constexpr std::size_t fresh_after = 64;
    const std::complex<double> turn = std::polar(1.0, -step_ * node.time);
    double re = 1;
    double im = 0;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (line % fresh_after == 0) {
            const double angle = step_ * static_cast<double>(line) * node.time;
            re = std::cos(angle);
            im = -std::sin(angle);
        }
        Integrals& sum = lines_[line];
        if (node.force != 0) sum.force += std::complex<double>(node.force * re, node.force * im);
        sum.acceleration += std::complex<double>(node.acceleration * re, node.acceleration * im);
        const double next = re * turn.real() - im * turn.imag();
        im = re * turn.imag() + im * turn.real();
        re = next;
    }
}

}  // namespace peterka::trace
