// The motion of a hammer that is disturbed at random: by white noise in its acceleration relative to the
// cart's, and by an amplitude and a frequency of the cart that differ from cycle to cycle.
//
// White noise acts as sudden changes of the velocity, evenly spaced over the cycle, the first after half an
// interval; between them the engine's own motion goes on (Strang's splitting, of second order in the interval
// for means). An interval is at most pi/4 of the hammer's phase and 1/16 of a cycle.
//
// A hammer that a softening spring throws out is at infinity from then on.
//
// A cycle whose cart has the amplitude (1 + a) A0 and the frequency (1 + f) Omega is computed in lengths of
// (1 + a) A0. Where two such cycles meet, at phase 0, the cart passes y = 0 with a new velocity, while the
// hammer keeps its own. There a state is told for a cart that passes with its usual velocity.
#pragma once

#include <cstdint>
#include <optional>

#include "noise/disturbance.hpp"
#include "noise/flight_steps.hpp"
#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "support/random_numbers.hpp"

namespace peterka::noise {

// Of a cart in one cycle, relative.
struct Deviations {
    double amplitude = 0;
    double frequency = 0;
    friend bool operator==(const Deviations&, const Deviations&) = default;
};

// A state (delta, delta') in A0 and A0 omega: at phase 0, or just after the n-th change of its cycle.
struct DisturbedState {
    scene::State<double> state;
    int changes = 0;
    Deviations cart = {};
    [[nodiscard]] bool at_phase_0() const { return changes == 0; }
};

// Of white noise, in a cycle of this length in tau.
[[nodiscard]] int changes_per_cycle(double period);

class DisturbedMap {
  public:
    DisturbedMap(const scene::Oscillator<double>& oscillator, const regime::EngineSettings& settings,
                 const Disturbance& disturbance);

    // The motion up to just after the next change or, after the last one of a cycle, to phase 0. False where
    // the engine can't follow it.
    [[nodiscard]] bool advance(DisturbedState& motion, RandomNumbers& random);
    // The state at the next phase 0 if no changes come before; nothing where the engine can't follow it.
    [[nodiscard]] std::optional<scene::State<double>> at_next_phase_0(const DisturbedState& motion);

    // Without disturbances, from phase 0 to phase 0: the end, its derivative by the start, and the covariance
    // of what white noise would add to it, to first order.
    struct Linear {
        scene::State<double> end;
        scene::Jacobian<double> jacobian;
        scene::Jacobian<double> covariance;
    };
    [[nodiscard]] std::optional<Linear> linear(const scene::State<double>& start);
    // The end for a cart that deviates, without white noise.
    [[nodiscard]] std::optional<scene::State<double>> deviating(const scene::State<double>& start,
                                                                const Deviations& cart);

    [[nodiscard]] bool has_rigid_stop() const { return scene::is_rigid(oscillator_.contact); }
    [[nodiscard]] int changes_per_cycle() const { return changes_; }
    // How often at_next_phase_0 was asked.
    [[nodiscard]] std::int64_t quiet_cycles() const { return quiet_cycles_; }
    [[nodiscard]] const Disturbance& disturbance() const { return disturbance_; }

  private:
    // The map of a cart that deviates, in its own lengths.
    struct Cart {
        Deviations deviations;
        double scale = 1;  // 1 + a
        double speed = 0;  // at phase 0, in A0 omega
        double period = 0;
        regime::CycleMap map;
        std::optional<FlightSteps> flight;  // by the map's closed form, if it has one
    };
    [[nodiscard]] Cart cart_of(const Deviations& deviations) const;
    [[nodiscard]] Cart& use(const Deviations& deviations);
    // Through the stretches from one of a cycle to before another: the whole cycle has changes_ + 1 of them.
    [[nodiscard]] bool carry(Cart& cart, scene::State<double>& state, int from, int to) const;
    // By the engine.
    [[nodiscard]] trajectory::Cycle<double> part(Cart& cart, const scene::State<double>& state, int from,
                                                 int to) const;
    // Standard deviation of a change in a cycle of this length.
    [[nodiscard]] double size_of_change(double period) const;
    void begin(DisturbedState& motion, const Deviations& cart);
    [[nodiscard]] bool finish(DisturbedState& motion);
    scene::Oscillator<double> oscillator_;
    regime::EngineSettings settings_;
    Disturbance disturbance_;
    int changes_;  // per cycle
    Stretches stretches_;
    std::int64_t quiet_cycles_ = 0;
    Cart usual_;
    Cart last_;  // the last cart that deviated
};

}  // namespace peterka::noise
