#include "trace/quantities.hpp"

#include <algorithm>
#include <cmath>

#include "trajectory/equation_of_motion.hpp"

namespace peterka::trace {

Quantities quantities(const scene::Oscillator<double>& scene, const Moment& moment) {
    const State<double>& x = moment.state;
    const double wave = std::sin(moment.angle);
    const double pull =
        trajectory::acceleration(scene, Phase::flight, x, moment.angle).value;  // u'' without a stop
    const bool presses = moment.phase == Phase::contact;
    const bool rigid = scene::is_rigid(scene.contact);
    // at rest on a rigid stop the force balances all others
    const double force = !presses ? 0 : std::max(0.0, rigid ? pull : trajectory::contact_force(scene, x));
    return {.cart = wave,
            .cart_velocity = scene.frequency * std::cos(moment.angle),
            .relative = x[0] + scene.gap,
            .relative_velocity = x[1],
            .acceleration = pull - force - scene.drive() * wave,
            .force = force};
}

double force_slope(const scene::Oscillator<double>& scene, const Moment& moment) {
    const State<double>& x = moment.state;
    const auto f = trajectory::contact_response(scene, x);
    const double a = trajectory::acceleration(scene, Phase::contact, x, moment.angle).value;
    return f.by_position * x[1] + f.by_velocity * a;
}

}  // namespace peterka::trace
