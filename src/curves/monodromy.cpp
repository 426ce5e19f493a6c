#include "curves/monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "curves/unknowns.hpp"
#include "trajectory/multiplier.hpp"

namespace peterka::curves {

namespace {

// The factors of the monodromy matrix from one event and the leg after it.
struct Factor {
    Jacobian<double> before;  // product of all factors up to the event
    Change change;
    Jacobian<double> flow;
    Jacobian<double> through;  // product up to the end of the leg
};

// The scale of an impact's speed: itself, but where it grazes.
double speed_of(const Event& event, double fastest) {
    constexpr double grazes = 1e-6;
    return std::max(std::abs(event.velocity), grazes * fastest);
}

// All factors of M, scaled as described at bifurcation(), and their product.
struct Product {
    std::vector<Factor> factors;
    Jacobian<double> matrix = Jacobian<double>::Identity();
    double determinant = 1;  // of the unscaled M
};

Product product_of(const PlacedRig& rig, const Orbit& orbit, Side side, double fastest) {
    const double duration = rig.duration_of(orbit.period);
    Product product;
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        const double length = orbit.length_of_leg(i, duration);
        Factor factor{product.matrix,
                      rig.saltation(event, side == Side::with_impact, speed_of(event, fastest)),
                      rig.flow(event.presses, length),
                      {}};
        product.matrix = (factor.flow * factor.change.value * factor.before).eval();
        factor.through = product.matrix;
        product.factors.push_back(factor);
        product.determinant *= std::exp(-2 * rig.damping(event.presses) * length);
        if (event.kind == EventKind::touch) product.determinant *= rig.determinant_of_touch();
    }
    return product;
}

bool strikes(const PlacedRig& rig, const Event& event) {
    return rig.is_rigid() && event.kind == EventKind::touch;
}

// The product of all impact speeds on a rigid stop, each over its scale, except that of event `left_out`.
double speeds_without(const PlacedRig& rig, const Orbit& orbit, double fastest, std::size_t left_out) {
    double product = 1;
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        if (strikes(rig, event) && i != left_out) product *= event.velocity / speed_of(event, fastest);
    }
    return product;
}

// M with the saltation of each impact on a rigid stop times its speed over the one that is given for it; its
// determinant is unscaled.
Monodromy multiplied(const PlacedRig& rig, const Orbit& orbit, Side side, const auto& speed_given) {
    const double duration = rig.duration_of(orbit.period);
    Monodromy product{Jacobian<double>::Identity(), 1};
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        const double length = orbit.length_of_leg(i, duration);
        const double speed = strikes(rig, event) ? speed_given(event) : 1;
        const Jacobian<double> jump = rig.saltation(event, side == Side::with_impact, speed).value;
        product.matrix = rig.flow(event.presses, length) * (jump * product.matrix).eval();
        product.determinant *= std::exp(-2 * rig.damping(event.presses) * length);
        if (event.kind == EventKind::touch) product.determinant *= rig.determinant_of_touch();
    }
    return product;
}

}  // namespace

double Monodromy::multiplier() const {
    return trajectory::largest_multiplier(matrix.trace() / 2, determinant);
}

Monodromy monodromy(const Rig& rigs, const Orbit& orbit, const PlanePoint& place, Side side) {
    return multiplied(rigs.at(place), orbit, side, [](const Event& event) { return event.velocity; });
}

double smooth_bifurcation(const Rig& rigs, const Orbit& orbit, const PlanePoint& place, int sign, Side side) {
    const PlacedRig rig = rigs.at(place);
    const double scale = rig.frequency();
    const Monodromy product = multiplied(rig, orbit, side, [scale](const Event&) { return scale; });
    double speeds = 1;
    for (const Event& event : orbit.events) {
        if (strikes(rig, event)) speeds *= event.velocity / scale;
    }
    return speeds * (1 + product.determinant) - sign * product.matrix.trace();
}

// Product rule: tr dM is the sum over all factors X of tr(after dX before). Liouville's formula: d ln det M is
// the sum over all legs of -2 b d(length).
Bifurcation bifurcation(const PlacedRig& rig, const Orbit& orbit, int sign, Side side) {
    const std::size_t count = orbit.events.size();
    const Unknowns unknowns(orbit);
    const double fastest = std::max(orbit.largest_speed(), rig.frequency());
    const auto [factors, matrix, determinant] = product_of(rig, orbit, side, fastest);
    const double speeds = speeds_without(rig, orbit, fastest, count);
    Bifurcation result{speeds * (1 + determinant) - sign * matrix.trace(),
                       Eigen::VectorXd::Zero(unknowns.size())};
    const auto add_by_place = [&](double by_frequency, double by_gap) {
        result.gradient[unknowns.column()] += rig.by_column(by_frequency, by_gap);
        result.gradient[unknowns.row()] += rig.by_row(by_frequency, by_gap);
    };
    // derivative of the last leg's length by the frequency
    const double last_longer = -rig.duration_of(orbit.period) / rig.frequency();
    Jacobian<double> after = Jacobian<double>::Identity();
    double size = speeds * (1 + determinant);
    for (std::size_t i = count; i-- > 0;) {
        const Event& event = orbit.events[i];
        const Factor& factor = factors[i];
        const double b = rig.damping(event.presses);
        Jacobian<double> generator;
        generator << 0, 1, -rig.stiffness(event.presses), -2 * b;
        const double longer =
            -sign * (after * generator * factor.through).trace() - 2 * b * speeds * determinant;
        result.gradient[unknowns.time(i)] -= longer;
        result.gradient[unknowns.time((i + 1) % count)] += longer;
        if (i + 1 == count) add_by_place(longer * last_longer, 0.0);
        size = std::max(size, after.norm() * factor.flow.norm() * (factor.change.value * factor.before).norm());
        after = (after * factor.flow).eval();
        const auto trace_of = [&](const Jacobian<double>& change) {
            return -sign * (after * change * factor.before).trace();
        };
        if (strikes(rig, event)) {
            result.gradient[unknowns.time(i)] += trace_of(factor.change.by_time);
            result.gradient[unknowns.velocity(i)] +=
                trace_of(factor.change.by_velocity) +
                speeds_without(rig, orbit, fastest, i) / speed_of(event, fastest) * (1 + determinant);
            add_by_place(trace_of(factor.change.by_frequency), trace_of(factor.change.by_gap));
        }
        after = (after * factor.change.value).eval();
    }
    result.value /= size;
    result.gradient /= size;
    return result;
}

}  // namespace peterka::curves
