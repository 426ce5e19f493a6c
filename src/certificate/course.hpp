// A motion with a cubic spring, by Taylor series in steps (Moore, Interval Analysis, 1966).
//
// Each step expands one motion, from a point, with Lagrange's remainder, whose coefficient is taken over a box
// that contains the motion during the step (reach.hpp). All other motions of the set stay within a ball around
// it, measured by the length r = sqrt(v^2 + K x^2) of the difference: with the slope s of the cubic term, r r'
// = -c v^2 - s x v <= |s| r^2/(2 sqrt(K)), so that r grows by at most exp(|s| t/(2 sqrt(K))).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "certificate/reach.hpp"

namespace peterka::certificate {

// A number without a radius, and how far others of the enclosure are from it.
inline double point_of(double x) {
    return x;
}
inline Interval point_of(const Interval& x) {
    return x.middle();
}
inline double spread_of(double /*x*/, double /*point*/) {
    return 0;
}
inline double spread_of(const Interval& x, const Interval& point) {
    return (x - point).size();
}
inline double highest(double x) {
    return x;
}
inline double highest(const Interval& x) {
    return x.hi;
}
inline double box_around(double middle, double /*radius*/) {
    return middle;
}
inline Interval box_around(const Interval& middle, double radius) {
    return middle + Interval(-radius, radius);
}
inline double span_of(double angle, double /*more*/) {
    return angle;
}
inline Interval span_of(const Interval& angle, double more) {
    return angle + Interval(0, more);
}

// The coefficient n of a product of series.
template <class Number, std::size_t terms>
Number coefficient_of_product(const std::array<Number, terms>& a, const std::array<Number, terms>& b,
                              std::size_t n) {
    Number sum(0);
    for (std::size_t i = 0; i <= n; ++i) sum = sum + a[i] * b[n - i];
    return sum;
}

// More digits need more terms.
template <class Number>
inline constexpr std::size_t taylor_order = 20;

template <class Number>
class Course {
  public:
    static constexpr std::size_t order = taylor_order<Number>;
    using Series = std::array<Number, order + 2>;

    // NOLINTNEXTLINE(modernize-pass-by-value): most numbers are small
    Course(const Phase<Number>& phase, const Number& time, const Vector<Number>& start)
        : phase_(&phase), time_(time), step_(step_of(phase, start)) {
        const Vector<Number> center{point_of(start.position), point_of(start.velocity)};
        steps_.push_back(step_from(0, center, spread(start, center)));
    }

    [[nodiscard]] Vector<Number> at(const Number& offset) const {
        const Step& step = step_at(lowest(offset), highest(offset));
        const bool is_before = lowest(offset) < step.begin - 0.1 * step_;  // bounds are of motions forward
        const Number s = offset - Number(step.begin);
        Vector<Number> state = value(step.series, s);
        const double ball = is_before ? NAN : step.ball * growth(step, size_of(s));
        state.position = box_around(state.position, ball / phase_->root_of_stiffness() * above);
        state.velocity = box_around(state.velocity, ball * above);
        return state;
    }

    [[nodiscard]] Matrix<Number> flow(const Number& length) const {
        const Step& last = step_at(lowest(length), highest(length));
        Matrix<Number> whole;
        for (std::size_t i = 0; &steps_[i] != &last; ++i) {
            whole = flow(steps_[i], Number(steps_[i + 1].begin) - Number(steps_[i].begin)) * whole;
        }
        return flow(last, length - Number(last.begin)) * whole;
    }

  private:
    static constexpr double above = 1 + 1e-12;

    struct Step {
        double begin;
        Series series;   // of delta; the last coefficient is the remainder's
        Series squares;  // of u^2, or (u + y)^2: the cubic term's slope over 3 gamma
        Series squares_of_box;
        double ball;   // distance r of the other motions, at the beginning
        double slope;  // largest slope of the cubic term during the step
        double reach;  // largest |u| during the step
    };

    // With longer steps the series would converge too slowly. Where the cubic term is a good part of the
    // springs' force, remainder and ball are wide and need shorter ones: of 7718 orbits of 25 random rigs with
    // strong cubic springs, 6.9 % have no proof without the last factor, and 2.5 % with it.
    static double step_of(const Phase<Number>& phase, const Vector<Number>& start) {
        const double c = size_of(phase.damping());
        const double k = size_of(phase.stiffness());
        const double u =
            size_of(start.position + phase.gap()) + size_of(start.velocity) / phase.root_of_stiffness();
        const double slope = phase.largest_cubic_slope(u);
        const double fastest = 0.5 * (c + std::sqrt(c * c + 4 * (k + slope)));
        return 1.2 / (std::max(fastest, size_of(phase.frequency())) * (1 + 8 * slope / k));
    }

    [[nodiscard]] double spread(const Vector<Number>& state, const Vector<Number>& center) const {
        const double v = spread_of(state.velocity, center.velocity);
        const double x = spread_of(state.position, center.position);
        return std::hypot(v, std::sqrt(size_of(phase_->stiffness())) * x) *
               above;  // squares could be too small
    }
    [[nodiscard]] double growth(const Step& step, double time) const {
        const double exponent = step.slope * time / (2 * phase_->root_of_stiffness());
        return (1 + exponent + exponent * exponent) * above;  // exp(x) up to x = 1
    }

    [[nodiscard]] Step step_from(double begin, const Vector<Number>& point, double ball) const {
        Step step{begin, {}, {}, {}, ball, 0, 0};
        const Number angle = phase_->frequency() * (time_ + Number(begin));
        const SineCosineOf<Number> now = sine_cosine(angle);
        step.series = series(point, now, step.squares);
        const Reach reach = reach_of(*phase_, point, step_);
        step.reach = reach.displacement + 2 * ball / phase_->root_of_stiffness();
        // The other motions of the set reach further by the ball's radius.
        step.slope = phase_->largest_cubic_slope(step.reach);
        if (!std::isfinite(step.slope) || step.slope * step_ > phase_->root_of_stiffness()) step.ball = NAN;
        const Vector<Number> box{box_around(point.position, reach.velocity * step_ * above),
                                 box_around(point.velocity, reach.acceleration * step_ * above)};
        const double turn = size_of(phase_->frequency()) * step_ * above;
        step.series[order + 1] = series(box, sine_cosine(span_of(angle, turn)), step.squares_of_box)[order + 1];
        return step;
    }

    // Taylor coefficients of delta from a state.
    [[nodiscard]] Series series(const Vector<Number>& state, const SineCosineOf<Number>& angle,
                                Series& u2) const {
        Series x{};  // of delta
        Series u{};  // of u, or of u + y
        Series y{};  // of the cart
        Series y2{};
        x[0] = state.position;
        x[1] = state.velocity;
        y[0] = angle.sine;
        y[1] = phase_->frequency() * angle.cosine;
        const bool absolute = phase_->absolute();
        for (std::size_t n = 0; n + 2 < x.size(); ++n) {
            u[n] = n == 0 ? x[0] + phase_->gap() : x[n];
            if (absolute) u[n] = u[n] + y[n];
            u2[n] = coefficient_of_product(u, u, n);
            Number cube = coefficient_of_product(u2, u, n);
            if (absolute) {
                y2[n] = coefficient_of_product(y, y, n);
                cube = cube - coefficient_of_product(y2, y, n);
            }
            const auto k = static_cast<double>(n);
            Number force = phase_->drive() * y[n] - phase_->damping() * Number(k + 1) * x[n + 1] -
                           phase_->stiffness() * x[n] - phase_->cubic() * cube;
            if (n == 0) force = force - phase_->gap();
            const Number over((k + 1) * (k + 2));
            x[n + 2] = force / over;
            y[n + 2] = -(phase_->drive() * y[n] / over);
        }
        return x;
    }

    // For a small difference w of two motions, w'' + c w' + (K + 3 gamma squares) w = 0.
    [[nodiscard]] Series difference(const Series& squares, const Number& w, const Number& rate) const {
        Series x{};
        x[0] = w;
        x[1] = rate;
        for (std::size_t n = 0; n + 2 < x.size(); ++n) {
            Number product(0);
            for (std::size_t i = 0; i <= n; ++i) product = product + squares[i] * x[n - i];
            const auto k = static_cast<double>(n);
            const Number force = phase_->damping() * Number(k + 1) * x[n + 1] + phase_->stiffness() * x[n] +
                                 Number(3) * phase_->cubic() * product;
            x[n + 2] = -(force / Number((k + 1) * (k + 2)));
        }
        return x;
    }

    // The flow of the step's center, and how much the surrounding ball may change it: the slope differs by 6
    // gamma (|u| + 1) times the distance.
    [[nodiscard]] Matrix<Number> flow(const Step& step, const Number& s) const {
        const double root = phase_->root_of_stiffness();
        const double large_root = std::sqrt(size_of(phase_->stiffness())) * above;
        const double most = growth(step, step_) * above;
        Series first = difference(step.squares, Number(1), Number(0));
        Series second = difference(step.squares, Number(0), Number(1));
        const auto within = [](double bound) { return plus_minus(bound, Number(0)); };
        constexpr std::size_t last = order + 1;
        first[last] = difference(step.squares_of_box, within(most), within(most * large_root))[last];
        second[last] = difference(step.squares_of_box, within(most / root * above), within(most))[last];
        const Vector<Number> left = value(first, s);
        const Vector<Number> right = value(second, s);
        const double change = 4 * 12 * size_of(phase_->cubic()) * (step.reach + 1) * step.ball / root * above;
        return phase_->changed({left.position, right.position, left.velocity, right.velocity}, s, change);
    }

    [[nodiscard]] static Vector<Number> value(const Series& series, const Number& s) {
        constexpr std::size_t last = order + 1;
        Number position = series[last];
        Number velocity = Number(static_cast<double>(last)) * series[last];
        for (std::size_t n = last; n-- > 0;) {
            position = position * s + series[n];
            if (n > 0) velocity = velocity * s + Number(static_cast<double>(n)) * series[n];
        }
        return {position, velocity};
    }

    // The step that contains both offsets; steps are computed on demand, and each extends slightly into the
    // next.
    [[nodiscard]] const Step& step_at(double from, double to) const {
        constexpr std::size_t most_steps = 100'000;
        while (!(to <= steps_.back().begin + 0.99 * step_) && steps_.size() < most_steps) {
            const Step& last = steps_.back();
            const double length = 0.95 * step_;
            const double begin = last.begin + length;
            const Vector<Number> end = value(last.series, Number(begin) - Number(last.begin));
            const Vector<Number> center{point_of(end.position), point_of(end.velocity)};
            const double ball = last.ball * growth(last, step_) + spread(end, center);
            steps_.push_back(step_from(begin, center, ball));
            if (!std::isfinite(steps_.back().ball)) break;
        }
        if (steps_.size() == most_steps) steps_.back().ball = NAN;  // nothing is proved of its end
        auto i = static_cast<std::size_t>(std::max(0.0, from / (0.95 * step_)));
        i = std::min(i, steps_.size() - 1);
        while (i > 0 && steps_[i].begin > from) --i;
        while (i + 1 < steps_.size() && to > steps_[i].begin + 0.99 * step_) ++i;
        return steps_[i];
    }

    const Phase<Number>* phase_;
    Number time_;
    double step_;
    mutable std::vector<Step> steps_;
};

}  // namespace peterka::certificate
