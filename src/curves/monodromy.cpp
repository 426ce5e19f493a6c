#include "curves/monodromy.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "curves/unknowns.hpp"

namespace peterka::curves {

namespace {

double length_of_leg(const Orbit& orbit, std::size_t i, const Place& place) {
    const bool last = i + 1 == orbit.events.size();
    return orbit.after(i).time - orbit.events[i].time + (last ? duration_of(orbit.period, place) : 0);
}

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
    Monodromy product{Jacobian<double>::Identity(), 1};
    for (std::size_t i = 0; i < orbit.events.size(); ++i) {
        const Event& event = orbit.events[i];
        const double length = length_of_leg(orbit, i, place);
        const bool counts = side == Side::with_impact;
        product.matrix = rig.flow(event.presses, length) *
                         (rig.saltation(event, place, counts).value * product.matrix).eval();
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
    const bool counts = side == Side::with_impact;
    std::vector<Factor> factors;
    Jacobian<double> up_to_here = Jacobian<double>::Identity();
    for (std::size_t i = 0; i < count; ++i) {
        const Event& event = orbit.events[i];
        Factor factor{up_to_here, rig.saltation(event, place, counts),
                      rig.flow(event.presses, length_of_leg(orbit, i, place)), {}};
        up_to_here = (factor.flow * factor.change.value * factor.before).eval();
        factor.through = up_to_here;
        factors.push_back(factor);
    }
    const Monodromy product = monodromy(rig, orbit, place, side);
    Bifurcation result{product.bifurcation(sign), Eigen::VectorXd::Zero(unknowns.size())};
    const double turn = 2 * std::numbers::pi * static_cast<double>(orbit.period);
    const double last_longer = -turn / (place.frequency * place.frequency);  // of the last leg, by the frequency
    Jacobian<double> after = Jacobian<double>::Identity();
    for (std::size_t i = count; i-- > 0;) {
        const Event& event = orbit.events[i];
        const Factor& factor = factors[i];
        const double b = rig.damping(event.presses);
        Jacobian<double> generator;
        generator << 0, 1, -rig.stiffness(event.presses), -2 * b;
        const double longer = -sign * (after * generator * factor.through).trace() - 2 * b * product.determinant;
        result.gradient[unknowns.time(i)] -= longer;
        result.gradient[unknowns.time((i + 1) % count)] += longer;
        if (i + 1 == count) result.gradient[unknowns.frequency()] += longer * last_longer;
        after = (after * factor.flow).eval();
        const auto trace_of = [&](const Jacobian<double>& change) {
            return -sign * (after * change * factor.before).trace();
        };
        const bool touches = event.kind == EventKind::touch && rig.is_rigid();
        if (touches) {
            result.gradient[unknowns.time(i)] += trace_of(factor.change.by_time);
            result.gradient[unknowns.velocity(i)] += trace_of(factor.change.by_velocity);
            result.gradient[unknowns.frequency()] += trace_of(factor.change.by_frequency);
            result.gradient[unknowns.gap()] += trace_of(factor.change.by_gap);
        }
        after = (after * factor.change.value).eval();
    }
    return result;
}

}  // namespace peterka::curves
