#include "certificate/stability.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::certificate {
namespace {

// A product of many matrices as Q R, with Q point numbers close to a rotation: R. J. Lohner's method to keep an
// enclosure narrow in the dominant direction of the product. (Enclosing the solutions of ordinary initial and
// boundary value problems, in Computer Arithmetic, Teubner 1987.)
class Product {
  public:
    void multiply(const Matrix<Interval>& next) {
        const Matrix<Interval> turned = next * frame_;
        const double a = turned.a.middle();
        const double c = turned.c.middle();
        const double length = std::hypot(a, c);
        if (!(length > 0)) return lose();
        frame_ = {a / length, -c / length, c / length, a / length};
        rest_ = (inverse(frame_) * turned) * rest_;
    }
    [[nodiscard]] Interval trace() const {
        const Matrix<Interval> whole = frame_ * rest_;
        return whole.a + whole.d;
    }

  private:
    void lose() { rest_ = {nothing(), nothing(), nothing(), nothing()}; }

    Matrix<Interval> frame_;
    Matrix<Interval> rest_;
};

}  // namespace

double stability_margin(const Interval& determinant, const Interval& trace) {
    const Interval by_determinant = Interval(1) - abs(determinant);
    const Interval by_trace = Interval(1) + determinant - abs(trace);
    if (std::isnan(by_trace.lo)) return by_trace.lo;
    return std::min(by_determinant.lo, by_trace.lo);
}

namespace {

// At a bounce with speed v a difference (d, d') goes over into (-r d, -r d' + (r a- + a+) d/v), with the
// accelerations a- before and a+ after it (A. B. Nordmark, Journal of Sound and Vibration 145, 1991); the
// damper's shares cancel in the sum, which is 1 + r times the acceleration at rest on the stop.
Matrix<Interval> saltation_of_bounce(const Springs<Interval>& springs, const Place<Interval>& place) {
    const Interval r = springs.rig.restitution;
    const Interval sine = sine_cosine(springs.flight.frequency() * place.time).sine;
    const Interval pressing = springs.flight.acceleration({Interval(0), Interval(0)}, sine);
    return {-r, Interval(0), (Interval(1) + r) * pressing / place.along, -r};
}

}  // namespace

Multipliers multipliers(const Springs<Interval>& springs, const EventChain& chain,
                        const std::vector<Place<Interval>>& places) {
    Product product;
    Interval contraction;     // -ln of the flows' determinants, exp(-c t) each
    Interval determinant(1);  // of the saltations: 1 of a touch, r^2 of a bounce
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (chain.events[i].kind == EventKind::touch) {
            product.multiply({Interval(1), Interval(0), -springs.rig.damping, Interval(1)});
        } else if (chain.events[i].kind == EventKind::bounce) {
            product.multiply(saltation_of_bounce(springs, places[i]));
            determinant = determinant * square(springs.rig.restitution);
        }
        const auto [leg, length] = leg_of(springs, chain, places, i);
        product.multiply(leg.flow(length));
        contraction += springs.phase(chain.presses(i)).damping() * length;
    }
    return {determinant * exp(-contraction), product.trace()};
}

double stability_margin(const Springs<Interval>& springs, const EventChain& chain,
                        const std::vector<Place<Interval>>& places) {
    const Multipliers of_orbit = multipliers(springs, chain, places);
    return stability_margin(of_orbit.determinant, of_orbit.trace);
}

}  // namespace peterka::certificate
