#include "certificate/patch.hpp"

#include <cmath>

#include "certificate/leg_proof.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_tries = 6;

Vector<Interval> as_vector(const Place<Interval>& place) {
    return {place.time, place.along};
}

Place<Interval> as_place(const Vector<Interval>& vector) {
    return {vector.position, vector.velocity};
}

Place<Interval> point(const Event& event) {
    return {Interval(event.time), Interval(event.along)};
}

bool inside(const Place<Interval>& place, const Place<Interval>& other) {
    return place.time.inside(other.time) && place.along.inside(other.along);
}

// Distances from the middle of a box grow by half, so that the next image can lie inside.
Place<Interval> widened(const Place<Interval>& place) {
    const auto wide = [](const Interval& x) {
        return around(x.middle(), 1.5 * x.radius() + 1e-16 * x.size() + 1e-300);
    };
    return {wide(place.time), wide(place.along)};
}

struct Ends {
    Place<Interval> of_middle;  // of m
    Place<Interval> of_all;
    Matrix<Interval> derivative;  // by the beginning's place
    Matrix<Interval> directions;  // by R
};

// `residual`: of m, or of all, at the guess.
template <class Equations>
std::optional<Ends> enclose_ends(const Event& guess, Place<Interval> box, const Vector<Interval>& residual,
                                 const Matrix<Interval>& frame, const Vector<Interval>& spread,
                                 const Equations& equations) {
    for (int tries = 0; tries < most_tries; ++tries) {
        const LegEquations<Interval> at = equations(box);
        const Matrix<Interval> by_end = inverse(columns(at.of_end_time, at.of_end_along));
        const Matrix<Interval> by_begin = columns(at.of_time, at.of_along);
        const Matrix<Interval> change = by_end * by_begin;
        const Matrix<Interval> derivative{-change.a, -change.b, -change.c, -change.d};
        const Matrix<Interval> directions = derivative * frame;
        const Vector<Interval> of_middle = as_vector(point(guess)) - by_end * residual;
        const Place<Interval> image = as_place(of_middle + directions * spread);
        if (!(image.time.radius() < 1) || !std::isfinite(image.along.size())) return std::nullopt;
        if (inside(image, box)) {
            return Ends{as_place(of_middle), image, derivative, directions};
        }
        box = widened({hull(image.time, Interval(guess.time)), hull(image.along, Interval(guess.along))});
    }
    return std::nullopt;
}

// Where a set's ends will be, from the derivatives at its middle, in doubles.
Place<Interval> expected_ends(const Springs<double>& springs, const EventChain& chain,
                              const Vector<Interval>& residual, const Matrix<Interval>& frame,
                              const Vector<Interval>& spread) {
    const Event& from = chain.events[0];
    const Event& to = chain.events[1];
    const LegEquations<double> at =
        leg_equations(springs, chain, {{from.time, from.along}, {to.time, to.along}}, 0);
    const Matrix<double> by_end = inverse(columns(at.of_end_time, at.of_end_along));
    const Matrix<double> directions =
        by_end * columns(at.of_time, at.of_along) *
        Matrix<double>{frame.a.middle(), frame.b.middle(), frame.c.middle(), frame.d.middle()};
    const auto reach = [](double a, double b, const Vector<Interval>& x) {
        return std::abs(a) * x.position.size() + std::abs(b) * x.velocity.size();
    };
    return widened(
        {around(to.time, reach(by_end.a, by_end.b, residual) + reach(directions.a, directions.b, spread)),
         around(to.along, reach(by_end.c, by_end.d, residual) + reach(directions.c, directions.d, spread))});
}

}  // namespace

Place<Interval> Patch::hull() const {
    const Vector<Interval> around = frame * spread;
    return {Interval(event.time) + around.position, Interval(event.along) + around.velocity};
}

Matrix<Interval> frame_along(const Matrix<Interval>& directions, const Vector<Interval>& spread) {
    const double first = std::hypot(directions.a.middle(), directions.c.middle()) * spread.position.size();
    const double second = std::hypot(directions.b.middle(), directions.d.middle()) * spread.velocity.size();
    const double x = first >= second ? directions.a.middle() : directions.b.middle();
    const double y = first >= second ? directions.c.middle() : directions.d.middle();
    const double length = std::hypot(x, y);
    if (!(length > 0)) return {};
    return {x / length, -y / length, y / length, x / length};
}

Patch patch_of(EventKind kind, const Place<Interval>& place) {
    const Event middle{kind, 0, place.time.middle(), place.along.middle()};
    return {middle, {}, as_vector(place) - as_vector(point(middle))};
}

std::optional<Passage> pass(const Springs<Interval>& springs, const Springs<double>& approximate,
                            const Patch& from, const Event& to) {
    Event begin = from.event;
    begin.cycle = 0;
    const EventChain chain{1, {begin, to}};
    const auto residual = leg_residual(springs, chain, {point(begin), point(to)}, 0);
    const Place<Interval> all = from.hull();
    const bool presses = presses_after(begin.kind);
    const Vector<Interval> leaving = springs.leaving(begin.kind);
    const Leg<Interval> leg(springs.phase(presses), all.time, scaled(leaving, all.along));
    const Interval cycles = Interval(static_cast<double>(to.cycle)) * springs.rig.period;
    const auto length = [&](const Place<Interval>& end) { return end.time - all.time + cycles; };
    const Place<Interval> expected = expected_ends(approximate, chain, residual, from.frame, from.spread);
    const auto equations = [&](const Place<Interval>& end) {
        return leg_equations(springs, leg, length(end), leaving, to.kind, end);
    };
    const auto ends = enclose_ends(to, expected, residual, from.frame, from.spread, equations);
    if (!ends || !leg_is_free(springs, leg, length(ends->of_all), presses, begin.kind, to.kind, ends->of_all))
        return std::nullopt;
    Patch next = patch_of(to.kind, ends->of_middle);
    const Vector<Interval> rounding = next.spread;
    next.frame = frame_along(ends->directions, from.spread);
    const Matrix<Interval> turned = inverse(next.frame);
    next.spread = (turned * ends->directions) * from.spread + turned * rounding;
    return Passage{next, ends->derivative};
}

std::optional<Patch> pass_from_start(const Springs<Interval>& springs, bool presses,
                                     const Vector<Interval>& state, const Event& to) {
    const Leg<Interval> leg(springs.phase(presses), Interval(0), state);
    const Interval cycles = Interval(static_cast<double>(to.cycle)) * springs.rig.period;
    const auto equations = [&](const Place<Interval>& end) {
        return leg_equations(springs, leg, end.time + cycles, {Interval(0), Interval(0)}, to.kind, end);
    };
    const Vector<Interval> residual = equations(point(to)).residual;
    const auto ends = enclose_ends(to, point(to), residual, {}, {Interval(0), Interval(0)}, equations);
    if (!ends ||
        !leg_is_free(springs, leg, ends->of_all.time + cycles, presses, std::nullopt, to.kind, ends->of_all))
        return std::nullopt;
    return patch_of(to.kind, ends->of_middle);
}

}  // namespace peterka::certificate
