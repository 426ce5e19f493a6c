#include "curves/defining_system.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "support/expect.hpp"

namespace peterka::curves {

namespace {

void add_legs(const PlacedRig& rig, const OrbitPoint& point, const Unknowns& unknowns, Equations& result) {
    const std::size_t count = point.orbit.events.size();
    const double duration = rig.duration_of(point.orbit.period);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const Event& from = point.orbit.events[i];
        const Event& to = point.orbit.events[next];
        const bool last = i + 1 == count;
        const LegEnd end =
            rig.leg(from.presses, from.time, rig.departure(from), to.time + (last ? duration : 0));
        const auto row = static_cast<Eigen::Index>(2 * i);
        result.values.segment<2>(row) = end.state - rig.arrival(to);
        const auto add = [&](Eigen::Index column, const State<double>& by) {
            result.jacobian.block<2, 1>(row, column) += by;
        };
        add(unknowns.time(i), end.by_start_time);
        add(unknowns.time(next), end.by_end_time);
        if (from.kind != EventKind::graze) {
            add(unknowns.velocity(i), end.by_start * rig.departure_by_velocity(from.kind));
        }
        if (to.kind != EventKind::graze) add(unknowns.velocity(next), -rig.arrival_by_velocity(to.kind));
        State<double> by_frequency = end.by_frequency;
        if (last) by_frequency -= end.by_end_time * duration / rig.frequency();
        add(unknowns.column(), rig.by_column(by_frequency, end.by_gap));
        add(unknowns.row(), rig.by_row(by_frequency, end.by_gap));
    }
}

void add_condition(const PlacedRig& rig, const OrbitPoint& point, const Unknowns& unknowns,
                   const Condition& condition, Eigen::Index row, Equations& result) {
    switch (condition.kind) {
        case Condition::Kind::line:
            result.values[row] = condition.normal.column * (point.place.column - condition.through.column) +
                                 condition.normal.row * (point.place.row - condition.through.row);
            result.jacobian(row, unknowns.column()) = condition.normal.column;
            result.jacobian(row, unknowns.row()) = condition.normal.row;
            return;
        case Condition::Kind::bifurcation: {
            const Bifurcation at = bifurcation(rig, point.orbit, condition.sign, condition.side);
            result.values[row] = at.value;
            result.jacobian.row(row) = at.gradient;
            return;
        }
        case Condition::Kind::slow:
            PETERKA_EXPECT(condition.event < point.orbit.events.size());
            result.values[row] = point.orbit.events[condition.event].velocity;
            result.jacobian(row, unknowns.velocity(condition.event)) = 1;
            return;
        case Condition::Kind::inflection: {
            const double eta = rig.frequency();
            const Event& event = point.orbit.events[condition.event];
            const double sine = std::sin(eta * event.time);
            const double cosine = std::cos(eta * event.time);
            result.values[row] = eta * eta * sine - rig.gap();
            result.jacobian(row, unknowns.time(condition.event)) = eta * eta * eta * cosine;
            const double by_frequency = 2 * eta * sine + eta * eta * event.time * cosine;
            result.jacobian(row, unknowns.column()) = rig.by_column(by_frequency, -1.0);
            result.jacobian(row, unknowns.row()) = rig.by_row(by_frequency, -1.0);
        }
    }
}

// With derivatives in closed form.
Equations equations_of(const PlacedRig& rig, const OrbitPoint& point,
                       const std::vector<Condition>& conditions) {
    const Unknowns unknowns(point.orbit);
    const auto legs = static_cast<Eigen::Index>(2 * point.orbit.events.size());
    const Eigen::Index rows = legs + static_cast<Eigen::Index>(conditions.size());
    Equations result{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, unknowns.size())};
    add_legs(rig, point, unknowns, result);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        add_condition(rig, point, unknowns, conditions[i], legs + static_cast<Eigen::Index>(i), result);
    }
    return result;
}

// The equations also have solutions on which a contact runs backwards from its touch. Beyond a grazing, where
// the touch has lost its speed, they lead to that grazing; else they are no motions.
bool has_contact_backwards(const Rig& rig, const OrbitPoint& point) {
    constexpr double rounding = 1e-9;  // of the orbit's duration
    const Orbit& orbit = point.orbit;
    const double duration = rig.at(point.place).duration_of(orbit.period);
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        if (event.kind == EventKind::touch && event.presses && event.velocity > 0 &&
            orbit.length_of_leg(i, duration) < -rounding * duration)
            return true;
    }
    return false;
}

double length_of(const Eigen::VectorXd& scaled_step) {
    return scaled_step.lpNorm<Eigen::Infinity>();
}

}  // namespace

Condition Condition::on_line(const PlanePoint& through, const PlanePoint& normal) {
    return {.kind = Kind::line, .through = through, .normal = normal};
}
Condition Condition::at_multiplier(int sign, Side side) {
    return {.kind = Kind::bifurcation, .sign = sign, .side = side};
}
Condition Condition::at_rest(std::size_t event) {
    return {.kind = Kind::slow, .event = event};
}
Condition Condition::without_acceleration(std::size_t event) {
    return {.kind = Kind::inflection, .event = event};
}

Equations equations(const Rig& rig, const OrbitPoint& point, const std::vector<Condition>& conditions) {
    PETERKA_EXPECT(point.orbit.period > 0 && !point.orbit.events.empty());
    Equations result = equations_of(rig.at(point.place), point, conditions);
    const Unknowns unknowns(point.orbit);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!rig.changes_along(axis)) continue;
        const double step = rig.step_of_difference(axis, point.place);
        const auto values_at = [&](double by) -> Eigen::VectorXd {
            const OrbitPoint there{point.orbit, moved(point.place, axis, by)};
            return equations_of(rig.at(there.place), there, conditions).values;
        };
        result.jacobian.col(axis == 0 ? unknowns.column() : unknowns.row()) =
            (values_at(step) - values_at(-step)) / (2 * step);
    }
    return result;
}

Eigen::VectorXd sizes_of_unknowns(const Rig& rig, const OrbitPoint& point, const PlanePoint& window) {
    const Orbit& orbit = point.orbit;
    const double frequency = rig.at(point.place).frequency();
    const Unknowns unknowns(orbit);
    const double share = std::sqrt(static_cast<double>(orbit.events.size()));
    const double speed = std::max(orbit.largest_speed(), 1e-3 * frequency);
    Eigen::VectorXd sizes(unknowns.size());
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        sizes[unknowns.time(i)] = share / frequency;
        if (orbit.events[i].kind != EventKind::graze) sizes[unknowns.velocity(i)] = share * speed;
    }
    sizes[unknowns.column()] = window.column;
    sizes[unknowns.row()] = window.row;
    return sizes;
}

double residual(const OrbitPoint& point, const Equations& equations) {
    return equations.values.lpNorm<Eigen::Infinity>() / (1 + point.orbit.largest_speed());
}

std::optional<OrbitPoint> solve(const Rig& rig, OrbitPoint guess, const PlanePoint& window,
                                const std::vector<Condition>& conditions) {
    constexpr int most_steps = 12;  // quadratic convergence needs 3 to 6
    constexpr double rounding = 2e-15;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= most_steps; ++step) {
        if (!(rig.at(guess.place).frequency() > 0)) return std::nullopt;
        const Equations at = equations(rig, guess, conditions);
        const double error = residual(guess, at);
        if (!std::isfinite(error) || !at.jacobian.allFinite()) return std::nullopt;
        // at rounding level a further step brings no improvement
        if (error <= largest_residual && (error < rounding || error > last / 4)) {
            if (has_contact_backwards(rig, guess)) return std::nullopt;
            return guess;
        }
        last = error;
        const Eigen::VectorXd sizes = sizes_of_unknowns(rig, guess, window);
        const Eigen::MatrixXd scaled = at.jacobian * sizes.asDiagonal();
        const Eigen::VectorXd move_by = -scaled.completeOrthogonalDecomposition().solve(at.values);
        if (!(length_of(move_by) < 0.5)) return std::nullopt;
        move(guess, move_by.cwiseProduct(sizes));
    }
    return std::nullopt;
}

Eigen::VectorXd tangent(const Rig& rig, const OrbitPoint& point, const PlanePoint& window,
                        const std::vector<Condition>& conditions) {
    const Eigen::VectorXd sizes = sizes_of_unknowns(rig, point, window);
    const Eigen::MatrixXd scaled = equations(rig, point, conditions).jacobian * sizes.asDiagonal();
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(scaled.transpose());
    const Eigen::Index size = sizes.size();
    Eigen::VectorXd last = Eigen::VectorXd::Zero(size);
    last[size - 1] = 1;
    return factors.householderQ() * last;
}

}  // namespace peterka::curves
