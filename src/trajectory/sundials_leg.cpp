#include "trajectory/sundials_leg.hpp"

#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>

#include "trajectory/contact_rates.hpp"

namespace peterka::trajectory {

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
    if (!std::isfinite(a.value) || !std::isfinite(y[1])) return -1;
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
    // Hunt and Crossley's law may have no second derivative at first touch; an iteration gets on without it
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

int leg_weights(N_Vector unknowns, N_Vector weights, void* leg_data) {
    constexpr double floor = 1e-3;       // of the response's size: below it errors count as absolute
    constexpr double flow_floor = 1e-6;  // the same for the flow, whose columns start with size 1
    const auto& leg = *static_cast<const SundialsLeg*>(leg_data);
    const auto& scene = leg.scene;
    const double* y = N_VGetArrayPointer(unknowns);
    double* w = N_VGetArrayPointer(weights);
    const bool contact = leg.phase == Phase::contact;
    const double u = y[0] + scene.gap;
    const double flight_rate = std::sqrt(1 + 3 * std::abs(scene.cubic) * u * u);
    const Rates rates =
        contact ? rates_of(linearized_contact(scene, {y[0], y[1]})) : Rates{flight_rate, flight_rate};
    const double response = scene.drive() / (1 + scene.drive());
    const double length = floor * (contact ? static_depth(scene, response + std::abs(scene.gap)) : response);
    for (int column = 0; column < leg_unknowns; column += 2) {
        const double smallest = column == 0 ? length : flow_floor / rates.fast;
        const double position = std::abs(y[column]);
        const double velocity = std::abs(y[column + 1]);
        w[column] = 1 / (leg.local_tolerance * (position + velocity / rates.fast + smallest));
        w[column + 1] = 1 / (leg.local_tolerance * (velocity + rates.slow * (position + smallest)));
        // the slope tells of a state that is not finite; a weight must be a number
        if (!(w[column] > 0)) w[column] = 1;
        if (!(w[column + 1] > 0)) w[column + 1] = 1;
    }
    return 0;
}

}  // namespace peterka::trajectory
