#include "curves/monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "curves/unknowns.hpp"

namespace peterka::curves {

namespace {

// What an event and its leg bring to the product.
struct Factor {
    Jacobian<double> before;  // all factors up to the event
    Change change;
    Jacobian<double> flow;
    Jacobian<double> through;  // up to the end of the leg
};

}  // namespace

double Monodromy::multiplier() const {
    const double half_trace = matrix.trace() / 2;
    const double discriminant = half_trace * half_trace - determinant;
    if (discriminant < 0) return std::copysign(std::sqrt(determinant), half_trace);
    return half_trace + std::copysign(std::sqrt(discriminant), half_trace);
}

Monodromy monodromy(const Rig& rig, const Orbit& orbit, const Place& place, Side side) {
    const double duration = duration_of(orbit.period, place);
    Monodromy product{Jacobian<double>::Identity(), 1};
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        const double length = orbit.length_of_leg(i, duration);
        const bool counts = side == Side::with_impact;
        const bool strikes = rig.is_rigid() && event.kind == EventKind::touch;
        const Jacobian<double> jump = rig.saltation(event, place, counts, strikes ? event.velocity : 1)
                                          .value;  // a speed of its own: unscaled
        product.matrix = rig.flow(event.presses, length) * (jump * product.matrix).eval();
        product.determinant *= std::exp(-2 * rig.damping(event.presses) * length);
        if (event.kind == EventKind::touch) product.determinant *= rig.determinant_of_touch();
    }
    return product;
}

// tr dM is the sum over all factors X of tr(after dX before), and d ln det M that over all legs of
// -2 b d(length).
Bifurcation bifurcation(const Rig& rig, const Orbit& orbit, const Place& place, int sign, Side side) {
    const std::size_t count = orbit.events.size();
    const Unknowns unknowns(orbit);
    const double duration = duration_of(orbit.period, place);
    const bool counts = side == Side::with_impact;
    const double speed = std::max(orbit.largest_speed(), place.frequency);
    const auto strikes = [&](std::size_t i) {
        return rig.is_rigid() && orbit.events[i].kind == EventKind::touch;
    };
    // The product of all speeds on a rigid stop, over the largest one, but for one of them.
    const auto speeds_without = [&](std::size_t left_out) {
        double product = 1;
        for (std::size_t i = 0; i < count; ++i) {
            if (strikes(i) && i != left_out) product *= orbit.events[i].velocity / speed;
        }
        return product;
    };
    double determinant = 1;
    std::vector<Factor> factors;
    Jacobian<double> up_to_here = Jacobian<double>::Identity();
    for (std::size_t i = 0; i < count; ++i) {
        const Event& event = orbit.events[i];
        Factor factor{up_to_here,
                      rig.saltation(event, place, counts, speed),
                      rig.flow(event.presses, orbit.length_of_leg(i, duration)),
                      {}};
        up_to_here = (factor.flow * factor.change.value * factor.before).eval();
        factor.through = up_to_here;
        factors.push_back(factor);
        determinant *= std::exp(-2 * rig.damping(event.presses) * orbit.length_of_leg(i, duration));
        if (event.kind == EventKind::touch) determinant *= rig.determinant_of_touch();
    }
    const double speeds = speeds_without(count);
    Bifurcation result{speeds * (1 + determinant) - sign * up_to_here.trace(),
                       Eigen::VectorXd::Zero(unknowns.size())};
    const double turn = 2 * std::numbers::pi * static_cast<double>(orbit.period);
    const double last_longer =
        -turn / (place.frequency * place.frequency);  // of the last leg, by the frequency
    Jacobian<double> after = Jacobian<double>::Identity();
    double size = 1;
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
        if (i + 1 == count) result.gradient[unknowns.frequency()] += longer * last_longer;
        size = std::max(size, after.norm() * factor.flow.norm() * (factor.change.value * factor.before).norm());
        after = (after * factor.flow).eval();
        const auto trace_of = [&](const Jacobian<double>& change) {
            return -sign * (after * change * factor.before).trace();
        };
        if (strikes(i)) {
            result.gradient[unknowns.time(i)] += trace_of(factor.change.by_time);
            result.gradient[unknowns.velocity(i)] +=
                trace_of(factor.change.by_velocity) + speeds_without(i) / speed * (1 + determinant);
            result.gradient[unknowns.frequency()] += trace_of(factor.change.by_frequency);
            result.gradient[unknowns.gap()] += trace_of(factor.change.by_gap);
        }
        after = (after * factor.change.value).eval();
    }
    result.value /= size;
    result.gradient /= size;
    return result;
}

}  // namespace peterka::curves
