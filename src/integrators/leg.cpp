#include "integrators/leg.hpp"

#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>

#include "trajectory/contact_rates.hpp"

namespace peterka::integrators {

using trajectory::linearized_contact;
using trajectory::Rates;
using trajectory::rates_of;
using trajectory::response_length;
using trajectory::static_depth;

void store(const LegPoint& point, N_Vector unknowns) {
    double* y = N_VGetArrayPointer(unknowns);
    std::copy_n(point.state.data(), 2, y);
    std::copy_n(point.flow.data(), 4, y + 2);
}

LegPoint load(N_Vector unknowns, double time) {
    const double* y = N_VGetArrayPointer(unknowns);
    return {time, State<double>(y), Jacobian<double>(y + 2)};
}

int leg_slope(double time, N_Vector unknowns, N_Vector slope, void* leg) {
    const double* y = N_VGetArrayPointer(unknowns);
    const auto a = static_cast<const SundialsLeg*>(leg)->acceleration_at({y[0], y[1]}, time);
    if (!std::isfinite(a.value)) return -1;  // as at each state that is not
    double* dy = N_VGetArrayPointer(slope);
    dy[0] = y[1];
    dy[1] = a.value;
    for (int column = 2; column < leg_unknowns; column += 2) {
        dy[column] = y[column + 1];
        dy[column + 1] = a.by_position * y[column] + a.by_velocity * y[column + 1];
    }
    return 0;
}

int leg_jacobian(double time, N_Vector unknowns, N_Vector /*slope*/, SUNMatrix jacobian, void* leg, N_Vector,
                 N_Vector, N_Vector) {
    const double* y = N_VGetArrayPointer(unknowns);
    const auto a = static_cast<const SundialsLeg*>(leg)->acceleration_at({y[0], y[1]}, time);
    // the Hunt-Crossley law may have no second derivative at first touch; the iteration converges without it
    const double bend = std::isfinite(a.by_position_twice) ? a.by_position_twice : 0;
    SUNMatZero(jacobian);
    for (int column = 0; column < leg_unknowns; column += 2) {
        SM_ELEMENT_D(jacobian, column, column + 1) = 1;
        SM_ELEMENT_D(jacobian, column + 1, column) = a.by_position;
        SM_ELEMENT_D(jacobian, column + 1, column + 1) = a.by_velocity;
        if (column == 0) continue;
        SM_ELEMENT_D(jacobian, column + 1, 0) = bend * y[column] + a.by_both * y[column + 1];
        SM_ELEMENT_D(jacobian, column + 1, 1) = a.by_both * y[column];
    }
    return 0;
}

namespace {

// Magnitudes in a leg below which errors are absolute.
struct Smallness {
    double position;
    double velocity;
};

// A rebound at a low speed w leads back to a rigid stop after about 2 w/a, on a hop of about w^2/a.
Rates rates_in_leg(const SundialsLeg& leg, const State<double>& x) {
    if (leg.phase == Phase::contact) return rates_of(linearized_contact(leg.oscillator, x));
    const double u = x[0] + leg.oscillator.gap;
    const double flight = std::sqrt(1 + 3 * std::abs(leg.oscillator.cubic) * u * u);
    if (leg.hop_speed == 0) return {flight, flight};
    return {flight, std::max(flight, std::abs(leg.acceleration_at({0, 0}, 0).value) / leg.hop_speed)};
}

Smallness smallness_in_leg(const SundialsLeg& leg, const Rates& rates) {
    constexpr double floor = 1e-3;  // of the response's size
    const double response = response_length(leg.oscillator);
    if (leg.hop_speed > 0) return {leg.hop_speed / rates.fast, leg.hop_speed};
    const double size = leg.phase == Phase::contact
                            ? static_depth(leg.oscillator, response + std::abs(leg.oscillator.gap))
                            : response;
    return {floor * size, rates.slow * floor * size};
}

}  // namespace

int leg_weights(N_Vector unknowns, N_Vector weights, void* leg_data) {
    constexpr double flow_floor = 1e-6;  // of the flow's columns, which start with size 1
    const auto& leg = *static_cast<const SundialsLeg*>(leg_data);
    const double* y = N_VGetArrayPointer(unknowns);
    double* w = N_VGetArrayPointer(weights);
    const Rates rates = rates_in_leg(leg, {y[0], y[1]});
    const Smallness of_state = smallness_in_leg(leg, rates);
    const Smallness of_flow{flow_floor / rates.fast, rates.slow * flow_floor / rates.fast};
    for (int column = 0; column < leg_unknowns; column += 2) {
        const Smallness& smallest = column == 0 ? of_state : of_flow;
        const double position = std::abs(y[column]);
        const double velocity = std::abs(y[column + 1]);
        w[column] = 1 / (leg.local_tolerance * (position + velocity / rates.fast + smallest.position));
        w[column + 1] = 1 / (leg.local_tolerance * (velocity + rates.slow * position + smallest.velocity));
        // leg_slope reports a non-finite state; a weight must be a number
        if (!(w[column] > 0)) w[column] = 1;
        if (!(w[column + 1] > 0)) w[column + 1] = 1;
    }
    return 0;
}

}  // namespace peterka::integrators
