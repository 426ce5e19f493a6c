#include "noise/disturbed_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "trajectory/cycle.hpp"

namespace peterka::noise {

namespace {

using Cycle = trajectory::Cycle<double>;
using State = scene::State<double>;
using Jacobian = scene::Jacobian<double>;

// The oscillator in lengths that are `scale` times as large.
scene::Oscillator<double> rescaled(scene::Oscillator<double> oscillator, double scale) {
    oscillator.gap /= scale;
    oscillator.cubic *= scale * scale;
    if (auto* stop = std::get_if<scene::HuntCrossley<double>>(&oscillator.contact)) {
        stop->stiffness *= std::pow(scale, stop->exponent - 1);
        stop->dissipation *= scale;
    }
    return oscillator;
}

// The flight of a map in closed form.
std::optional<motion::LinearMotion<double>> flight_of(const regime::CycleMap& map) {
    const auto linear = [](const scene::Oscillator<double>& oscillator) {
        const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
        return FlightSteps::suits(flight) ? std::optional(flight) : std::nullopt;
    };
    if (const auto* exact = std::get_if<trajectory::ExactCycleMap<double>>(&map))
        return linear(exact->oscillator());
    if (const auto* rigid = std::get_if<trajectory::RigidExactMap<double>>(&map))
        return linear(rigid->oscillator());
    return std::nullopt;
}

// A softening spring throws the hammer out within a finite time.
const State thrown_out = State::Constant(std::numeric_limits<double>::infinity());

}  // namespace

int changes_per_cycle(double period) {
    constexpr int fewest = 16;
    return std::max(fewest, static_cast<int>(std::ceil(period / (std::numbers::pi / 4))));
}

DisturbedMap::DisturbedMap(const scene::Oscillator<double>& oscillator, const regime::EngineSettings& settings,
                           const Disturbance& disturbance)
    : oscillator_(oscillator),
      settings_(settings),
      disturbance_(disturbance),
      changes_(noise::changes_per_cycle(oscillator.period())),
      stretches_(changes_),
      usual_(cart_of({})),
      last_(cart_of({})) {}

double DisturbedMap::size_of_change(double period) const {
    return disturbance_.speed * std::sqrt(period / changes_);
}

DisturbedMap::Cart DisturbedMap::cart_of(const Deviations& deviations) const {
    const double scale = 1 + deviations.amplitude;
    scene::Oscillator<double> oscillator = rescaled(oscillator_, scale);
    oscillator.frequency *= 1 + deviations.frequency;
    regime::EngineSettings settings = settings_;
    settings.largest_displacement /= scale;
    Cart cart{.deviations = deviations,
              .scale = scale,
              .speed = scale * oscillator.frequency,
              .period = oscillator.period(),
              .map = regime::make_cycle_map(oscillator, settings),
              .flight = std::nullopt};
    if (const auto flight = flight_of(cart.map)) cart.flight.emplace(*flight, cart.period, stretches_);
    return cart;
}

DisturbedMap::Cart& DisturbedMap::use(const Deviations& deviations) {
    if (deviations == usual_.deviations) return usual_;
    if (deviations != last_.deviations) last_ = cart_of(deviations);
    return last_;
}

// state: in the cart's lengths.
Cycle DisturbedMap::part(Cart& cart, const State& state, int from, int to) const {
    const double begin = stretches_.ends[static_cast<std::size_t>(from)] * cart.period;
    const double end = stretches_.ends[static_cast<std::size_t>(to)] * cart.period;
    return std::visit([&](auto& map) -> Cycle { return map.part(state, begin, end); }, cart.map);
}

bool DisturbedMap::carry(Cart& cart, State& state, int from, int to) const {
    if (!state.allFinite()) return true;
    State scaled = state / cart.scale;
    for (int n = from; n < to;) {
        const auto end = cart.flight ? cart.flight->end_of(static_cast<std::size_t>(n), scaled) : std::nullopt;
        if (end) {
            scaled = *end;
            ++n;
            continue;
        }
        // one that is at the stop may stay there for long
        const int until = cart.flight && scaled[0] < 0 ? n + 1 : to;
        const Cycle cycle = part(cart, scaled, n, until);
        if (cycle.outcome == Cycle::Outcome::not_finite) {
            state = thrown_out;
            return true;
        }
        if (cycle.outcome != Cycle::Outcome::done) return false;
        scaled = cycle.end;
        n = until;
    }
    state = scaled * cart.scale;
    return true;
}

void DisturbedMap::begin(DisturbedState& motion, const Deviations& cart) {
    motion.cart = cart;
    motion.state[1] -= use(cart).speed - usual_.speed;
}

// The rest of a cycle.
bool DisturbedMap::finish(DisturbedState& motion) {
    Cart& cart = use(motion.cart);
    if (!carry(cart, motion.state, motion.changes, changes_ + 1)) return false;
    motion.state[1] += cart.speed - usual_.speed;
    motion.cart = {};
    motion.changes = 0;
    return true;
}

bool DisturbedMap::advance(DisturbedState& motion, RandomNumbers& random) {
    if (motion.changes == changes_) return finish(motion);
    if (motion.at_phase_0() && (disturbance_.amplitude > 0 || disturbance_.frequency > 0)) {
        const double amplitude = random.normal();
        begin(motion, {disturbance_.amplitude * amplitude, disturbance_.frequency * random.normal()});
    }
    Cart& cart = use(motion.cart);
    if (!carry(cart, motion.state, motion.changes, motion.changes + 1)) return false;
    ++motion.changes;
    if (disturbance_.speed > 0) motion.state[1] += size_of_change(cart.period) * random.normal();
    return true;
}

std::optional<State> DisturbedMap::at_next_phase_0(const DisturbedState& motion) {
    ++quiet_cycles_;
    DisturbedState end = motion;
    if (!finish(end)) return std::nullopt;
    return end.state;
}

std::optional<State> DisturbedMap::deviating(const State& start, const Deviations& cart) {
    DisturbedState motion{start};
    begin(motion, cart);
    return at_next_phase_0(motion);
}

std::optional<DisturbedMap::Linear> DisturbedMap::linear(const State& start) {
    Linear cycle{start, Jacobian::Identity(), Jacobian::Zero()};
    const double variance = std::pow(size_of_change(usual_.period), 2);
    for (int n = 0; n <= changes_; ++n) {
        const Cycle stretch = part(usual_, cycle.end, n, n + 1);
        if (stretch.outcome != Cycle::Outcome::done) return std::nullopt;
        const Jacobian& flow = stretch.jacobian;
        cycle.end = stretch.end;
        cycle.jacobian = flow * cycle.jacobian;
        cycle.covariance = flow * cycle.covariance * flow.transpose();
        if (n < changes_) cycle.covariance(1, 1) += variance;
    }
    return cycle;
}

}  // namespace peterka::noise
