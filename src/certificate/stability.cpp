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
        const Interval determinant = frame_.a * frame_.d - frame_.b * frame_.c;
        const Matrix<Interval> inverse{frame_.d / determinant, -frame_.b / determinant, -frame_.c / determinant,
                                       frame_.a / determinant};
        rest_ = (inverse * turned) * rest_;
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

double stability_margin(const Springs<Interval>& springs, const EventChain& chain,
                        const std::vector<Place<Interval>>& places) {
    Product product;
    Interval contraction;  // -ln det M: each flow has determinant exp(-c t), a saltation 1
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (chain.events[i].kind == EventKind::touch) {
            product.multiply({Interval(1), Interval(0), -springs.rig.damping, Interval(1)});
        }
        const auto [leg, length] = leg_of(springs, chain, places, i);
        product.multiply(leg.flow(length));
        contraction += springs.phase(chain.presses(i)).damping() * length;
    }
    return stability_margin(exp(-contraction), product.trace());
}

}  // namespace peterka::certificate
