#include "certificate/trap.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "certificate/find_chain.hpp"

namespace peterka::certificate {
namespace {

constexpr double largest_radius = 0.3;
constexpr double smallest_radius = 1e-9;

// The derivatives of the legs, (time, along) of each end by those of its beginning, in doubles.
std::vector<Eigen::Matrix2d> derivatives_of_legs(const Springs<double>& springs, const EventChain& chain) {
    const std::vector<Place<double>> places = places_of(chain);
    std::vector<Eigen::Matrix2d> derivatives;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const LegEquations<double> leg = leg_equations(springs, chain, places, i);
        Eigen::Matrix2d by_begin;
        Eigen::Matrix2d by_end;
        by_begin << leg.of_time.position, leg.of_along.position, leg.of_time.velocity, leg.of_along.velocity;
        by_end << leg.of_end_time.position, leg.of_end_along.position, leg.of_end_time.velocity,
            leg.of_end_along.velocity;
        derivatives.emplace_back(-(by_end.inverse() * by_begin));
    }
    return derivatives;
}

struct ReturnMap {
    std::size_t event = 0;
    Eigen::Matrix2d derivative = Eigen::Matrix2d::Identity();
};

// The event at which its derivative is smallest: all have the same eigenvalues, but where the orbit nearly
// grazes before it contracts, the derivative may be as large as a neighbourhood is small.
ReturnMap smallest_return_map(const Springs<double>& springs, const EventChain& chain) {
    const std::vector<Eigen::Matrix2d> legs = derivatives_of_legs(springs, chain);
    ReturnMap best;
    for (std::size_t first = 0; first < legs.size(); ++first) {
        Eigen::Matrix2d whole = Eigen::Matrix2d::Identity();
        for (std::size_t i = 0; i < legs.size(); ++i) whole = legs[(first + i) % legs.size()] * whole;
        if (first == 0 || whole.norm() < best.derivative.norm()) best = {first, whole};
    }
    return best;
}

// P with a norm of P^-1 M P close to the largest |eigenvalue|: real and imaginary part of an eigenvector, or
// Schur's vectors, the second shortened by so much that what lies off the diagonal matters little. In closed
// form: Eigen's decompositions, made for any size, take many seconds to compile.
Eigen::Matrix2d coordinates_for(const Eigen::Matrix2d& m) {
    const double middle = m.trace() / 2;
    const double half_difference = (m(0, 0) - m(1, 1)) / 2;
    const double discriminant = half_difference * half_difference + m(0, 1) * m(1, 0);
    if (discriminant < 0) {
        Eigen::Matrix2d basis;
        basis << m(0, 1), 0, -half_difference, std::sqrt(-discriminant);
        return basis / basis.norm();
    }
    // The longer column of M - (the other eigenvalue) I.
    const double root = std::copysign(std::sqrt(discriminant), half_difference);
    const Eigen::Vector2d one(half_difference + root, m(1, 0));
    const Eigen::Vector2d other(m(0, 1), root - half_difference);
    Eigen::Vector2d first = one.norm() > other.norm() ? one : other;
    first = first.norm() > 0 ? first.normalized() : Eigen::Vector2d::UnitX();
    Eigen::Matrix2d schur;
    schur << first, Eigen::Vector2d(-first.y(), first.x());
    const Eigen::Matrix2d triangular = schur.transpose() * m * schur;
    const double largest = std::abs(middle) + std::abs(root);
    const double beside = std::abs(triangular(0, 1));
    const double shorter = std::min(1.0, 0.5 * (1 - largest) / std::max(beside, 1e-300));
    return schur * Eigen::Vector2d(1, shorter).asDiagonal();
}

Matrix<Interval> enclosed(const Eigen::Matrix2d& m) {
    return {Interval(m(0, 0)), Interval(m(0, 1)), Interval(m(1, 0)), Interval(m(1, 1))};
}

// Upper bound of the square of the Euclidean norm: the larger sum of a row of A^T A.
double norm_squared(const Matrix<Interval>& m) {
    const Interval first = square(m.a) + square(m.c);
    const Interval second = square(m.b) + square(m.d);
    const Interval off = abs(m.a * m.b + m.c * m.d);
    return (larger(first, second) + off).hi;
}

// A product of many matrices, enclosed as frame times rest (R. J. Lohner, as in stability.cpp).
bool contracts(const Springs<Interval>& springs, const Springs<double>& approximate, const EventChain& chain,
               std::size_t first, Patch patch, const Matrix<Interval>& to_coordinates) {
    Matrix<Interval> whole = patch.frame;
    for (std::size_t leg = 0; leg < chain.events.size(); ++leg) {
        const std::size_t i = (first + leg) % chain.events.size();
        Event to = chain.events[chain.next(i)];
        to.cycle = chain.cycles_of_leg(i);
        const std::optional<Passage> passage = pass(springs, approximate, patch, to);
        if (!passage) return false;
        whole = passage->derivative * whole;
        patch = passage->end;
    }
    return norm_squared(to_coordinates * whole) < 1;
}

}  // namespace

bool Trap::holds(const Patch& patch) const {
    if (patch.event.kind != event.kind) return false;
    const Vector<Interval> away{Interval(patch.event.time) - orbit.time,
                                Interval(patch.event.along) - orbit.along};
    const Vector<Interval> b = coordinates * away + (coordinates * patch.frame) * patch.spread;
    return (square(b.position) + square(b.velocity)).hi < square(Interval(radius)).lo;
}

std::optional<Trap> find_trap(const Springs<Interval>& springs, const Springs<double>& approximate,
                              const EventChain& chain, const std::vector<Place<Interval>>& places) {
    const auto [event, derivative] = smallest_return_map(approximate, chain);
    if (!derivative.allFinite()) return std::nullopt;
    const Matrix<Interval> basis = enclosed(coordinates_for(derivative));
    Trap trap{chain.events[event], places[event], inverse(basis), 0};
    Patch around_orbit = patch_of(trap.event.kind, places[event]);
    // How far x* may lie from the middle of the set, in coordinates.
    const Vector<Interval> off = trap.coordinates * around_orbit.spread;
    around_orbit.frame = basis;
    for (double radius = largest_radius; radius > smallest_radius; radius /= 4) {
        around_orbit.spread = {Interval(-radius, radius), Interval(-radius, radius)};
        if (!contracts(springs, approximate, chain, event, around_orbit, trap.coordinates)) continue;
        trap.radius = radius - std::max(off.position.size(), off.velocity.size());
        if (trap.radius > 0) return trap;
    }
    return std::nullopt;
}

}  // namespace peterka::certificate
