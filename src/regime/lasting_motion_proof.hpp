// Statements about all future time: motions that never touch the stop again, and contacts that never end.
//
// Without a cubic spring both are linear, and the rest of their transients only decays: a closed-form proof.
// With one, the motion without a stop is a periodic orbit o(t) found by Newton's method, and the deviation
// e = u - o obeys the linear equation with a right-hand side of at most L |e|, L = 3 cubic M^2 for |u|, |o| <=
// M. The response to a bounded right-hand side is at most H times the bound, H = integral of |impulse
// response|, so |e| <= R/(1 - L H) for all time, with R the linear amplitude of the present e (small-gain
// theorem, Zames 1966). Lasting contacts are then proved as orbits, as are those on a stop that is neither
// linear nor rigid. Newton's method for o(t) costs as much as 60 cycles of a batch, so it waits for a state
// close enough to the steady motion without the cubic spring: o(t) lies near that one, too.
#pragma once

#include <optional>
#include <variant>

#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "trajectory/free_flight.hpp"
#include "trajectory/lasting_contact.hpp"

namespace peterka::regime {

// A motion of one forcing period that a trajectory never leaves.
struct SettledMotion {
    scene::State<double> point;       // (delta, delta') at forcing phase 0
    Eigen::Matrix2d jacobian;         // of one cycle
    double peak_force = 0;            // F/(k A0)
    double largest_displacement = 0;  // of |u|
    bool decays = true;               // otherwise the start's free vibration persists
};

// H of the free hammer: the integral of |impulse response| of u'' + 2 zeta u' + u over all times.
double gain(double damping_ratio);

// For a hammer with linear springs in flight, from the state at forcing phase 0: it stays free for ever.
// Nothing if this isn't proved.
[[nodiscard]] std::optional<SettledMotion> free_for_ever(const trajectory::FreeFlight<double>& flight,
                                                         const scene::State<double>& x);

class LastingMotionProof {
  public:
    explicit LastingMotionProof(const StroboscopicMap& map);

    // Proved for all future time, from the state at forcing phase 0; nothing if not.
    [[nodiscard]] std::optional<SettledMotion> stays_free(const scene::State<double>& x);
    [[nodiscard]] std::optional<SettledMotion> stays_in_contact(const scene::State<double>& x) const;

    // Whether such a motion exists for some start, as far as is known.
    [[nodiscard]] bool may_settle();

  private:
    // std::monostate: nothing is proved, as for a law without a closed form of its lasting contacts.
    using Contact =
        std::variant<std::monostate, trajectory::LinearContact<double>, trajectory::RigidContact<double>>;
    static Contact contact_of(const scene::Oscillator<double>& oscillator);

    struct FreeOrbit {
        scene::State<double> point;
        Eigen::Matrix2d jacobian;
        double largest_displacement;
    };
    // With a cubic spring.
    [[nodiscard]] std::optional<FreeOrbit> find_free_orbit() const;
    [[nodiscard]] const FreeOrbit* free_orbit();  // nullptr: none
    [[nodiscard]] double room_of_free_orbits() const;
    [[nodiscard]] double amplitude(const scene::State<double>& deviation) const;
    [[nodiscard]] double lipschitz() const;  // L
    [[nodiscard]] double loop() const;       // L H
    [[nodiscard]] bool close_enough(const scene::State<double>& x, const FreeOrbit& orbit) const;

    // First what is read after every cycle.
    bool may_stay_free_ = false;  // with a cubic spring: as far as is known
    bool may_stay_in_contact_ = false;
    double room_ = 0;              // see room_of_free_orbits()
    scene::State<double> steady_;  // of the free flight
    scene::Oscillator<double> oscillator_;
    EngineSettings settings_;
    trajectory::FreeFlight<double> free_flight_;  // of the oscillator without its cubic spring
    Contact contact_;                             // the same
    bool looked_for_orbit_ = false;
    std::optional<FreeOrbit> free_orbit_;  // of an oscillator with a cubic spring, once it was looked for
};

}  // namespace peterka::regime
