// A cell's constants in a batch: grid steps, responses to the forcing, one step of flight.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "batch/batched_cycle_map.hpp"
#include "motion/linear_motion.hpp"
#include "trajectory/spring_change.hpp"

namespace peterka::batch {

namespace {

// The range of small_sine_cosine, and of the six steps allowed in a stretch of flight.
constexpr double longest_step = std::numbers::pi / 4 + 1e-9;

// Whether the kernel's closed forms are accurate for a motion.
bool is_regular(const motion::LinearMotion<double>& motion) {
    return motion.oscillates() && !motion.near_critical() && !motion.resonant();
}

}  // namespace

int BatchedCycleMap::steps_for(double frequency) {
    const auto longest = [&](int steps) { return 2 * std::numbers::pi / (frequency * steps); };
    int steps = 10;
    if (longest(steps) > longest_step) steps = 16;
    while (longest(steps) > longest_step && steps < 1024) steps *= 2;
    return steps;
}

BatchedCycleMap::Forcing BatchedCycleMap::forcing_of(const scene::Oscillator<double>& oscillator) const {
    const double frequency = oscillator.frequency;
    const auto cubic = trajectory::cubic_about_stop(oscillator);
    const motion::LinearMotion<double> flight(cubic(motion::flight_equation(oscillator)));
    const auto* stop = oscillator.spring_dashpot();  // nullptr: rigid
    const motion::LinearMotion<double> contact(stop != nullptr ? cubic(motion::contact_equation(oscillator))
                                                               : flight.equation());
    Forcing f;
    f.frequency = frequency;
    f.gap = oscillator.gap;
    const double step = oscillator.period() / grid_.steps;
    const double fastest = std::max({1.0, frequency, flight.natural_frequency()});
    const bool relative = oscillator.cubic == 0 || oscillator.cubic_form == job::CubicForm::relative;
    const bool can_press = rig_ ? rig_->fit : stop == nullptr || stop->stiffness > 0;
    f.fit =
        can_press && is_regular(flight) && is_regular(contact) && relative && step * fastest <= longest_step;
    const double square = flight.equation().stiffness;
    const double re = flight.response().real();
    const double im = flight.response().imag();
    f[Field::frequency] = frequency;
    f[Field::step] = step;
    f[Field::flight_re] = re;
    f[Field::flight_im] = im;
    f[Field::swing] = std::abs(flight.response());
    f[Field::contact_re] = contact.response().real();
    f[Field::contact_im] = contact.response().imag();
    f[Field::contact_swing] = std::abs(contact.response());
    f[Field::flight_square] = square;
    f[Field::flight_rate] = flight.rate();
    f[Field::contact_rate] = contact.rate();
    f[Field::margin_per_speed] = square * square / flight.rate() * std::pow(step, 4) / 144;

    // x -> E x + (s' - E s), with s the steady motion at the step's start, with coefficients (re, im) and eta
    // (-im, re) of its sine and cosine, and s' the same one step later
    const scene::Jacobian<double> flow = flight.flow(step);
    f[Field::e00] = flow(0, 0);
    f[Field::e01] = flow(0, 1);
    f[Field::e10] = flow(1, 0);
    f[Field::e11] = flow(1, 1);
    const double c = grid_.cosine[1];
    const double s = grid_.sine[1];
    f[Field::forced_delta_sine] = (re * c - im * s) - (flow(0, 0) * re - flow(0, 1) * frequency * im);
    f[Field::forced_delta_cosine] = (re * s + im * c) - (flow(0, 0) * im + flow(0, 1) * frequency * re);
    f[Field::forced_velocity_sine] =
        -frequency * (re * s + im * c) - (flow(1, 0) * re - flow(1, 1) * frequency * im);
    f[Field::forced_velocity_cosine] =
        frequency * (re * c - im * s) - (flow(1, 0) * im + flow(1, 1) * frequency * re);
    return f;
}

}  // namespace peterka::batch
