#include "trace/quantities.hpp"

#include <algorithm>
#include <cmath>

#include "trajectory/equation_of_motion.hpp"

namespace peterka::trace {

Quantities quantities(const scene::Oscillator<double>& oscillator, const Instant& instant) {
    const State<double>& x = instant.state;
    const double wave = std::sin(instant.angle);
    const double pull =
        trajectory::acceleration(oscillator, Phase::flight, x, instant.angle).value;  // u'' without a stop
    const bool presses = instant.phase == Phase::contact;
    const bool rigid = scene::is_rigid(oscillator.contact);
    // at rest on a rigid stop the force balances all others
    const double force = !presses ? 0 : std::max(0.0, rigid ? pull : trajectory::contact_force(oscillator, x));
    return {.cart = wave,
            .cart_velocity = oscillator.frequency * std::cos(instant.angle),
            .relative = x[0] + oscillator.gap,
            .relative_velocity = x[1],
            .acceleration = pull - force - oscillator.drive() * wave,
            .force = force};
}

double force_slope(const scene::Oscillator<double>& oscillator, const Instant& instant) {
    const State<double>& x = instant.state;
    const auto f = trajectory::contact_response(oscillator, x);
    const double a = trajectory::acceleration(oscillator, Phase::contact, x, instant.angle).value;
    return f.by_position * x[1] + f.by_velocity * a;
}

}  // namespace peterka::trace
