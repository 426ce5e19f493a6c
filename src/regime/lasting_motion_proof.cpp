#include "regime/lasting_motion_proof.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "regime/scalar_engine.hpp"

namespace peterka::regime {

namespace {

Task<CycleResult> one_cycle(StroboscopicMap& map, Point from, Recorder<double>& recorder) {
    co_return co_await map.cycle(from, &recorder);
}

}  // namespace

double gain(double damping_ratio) {
    if (damping_ratio >= 1) return 1;
    return 1 / std::tanh(std::numbers::pi * damping_ratio / (2 * std::sqrt(1 - damping_ratio * damping_ratio)));
}

LastingMotionProof::LastingMotionProof(const StroboscopicMap& map)
    : oscillator_(map.oscillator()),
      settings_(map.settings()),
      free_flight_(without_cubic(map.oscillator())),
      contact_(contact_of(without_cubic(map.oscillator()))) {
    if (oscillator_.cubic != 0) {
        steady_ = free_flight_.steady();
        room_ = room_of_free_orbits();
        may_stay_free_ = room_ > 0 && loop() < 1;
    } else {
        may_stay_free_ = free_flight_.may_last();
        may_stay_in_contact_ = std::visit(
            []<class Law>(const Law& contact) {
                if constexpr (std::is_same_v<Law, std::monostate>)
                    return false;
                else
                    return contact.may_last();
            },
            contact_);
    }
}

std::optional<LastingMotionProof::FreeOrbit> LastingMotionProof::find_free_orbit() const {
    const double amplitude = free_flight_.amplitude();
    if (!std::isfinite(amplitude)) return std::nullopt;
    // the same hammer with its stop out of reach
    scene::Oscillator<double> far = oscillator_;
    far.gap = 4 * (1 + amplitude);
    CycleBroker broker;
    StroboscopicMap free_map(far, settings_, broker);
    const scene::State<double> start(steady_[0] + oscillator_.gap - far.gap, steady_[1]);
    const auto orbit = complete(find_orbit(free_map, free_map.scaled(start), 1), broker);
    if (!orbit || !(orbit->multiplier < 1)) return std::nullopt;
    Recorder<double> recorder;
    const CycleResult cycle = complete(one_cycle(free_map, orbit->point(), recorder), broker);
    if (!cycle.ok || cycle.touched) return std::nullopt;
    const scene::State<double> point = free_map.unscaled(orbit->point());
    return FreeOrbit{{point[0] + far.gap - oscillator_.gap, point[1]},
                     free_map.unscaled(orbit->jacobian),
                     recorder.totals().displacement_bound};
}

const LastingMotionProof::FreeOrbit* LastingMotionProof::free_orbit() {
    if (!std::exchange(looked_for_orbit_, true)) free_orbit_ = find_free_orbit();
    return free_orbit_ ? &*free_orbit_ : nullptr;
}

// Linear amplitude of a deviation at a moment, from the energy where the motion doesn't oscillate.
double LastingMotionProof::amplitude(const scene::State<double>& deviation) const {
    const double zeta = oscillator_.damping_ratio;
    if (zeta >= 0.99) return deviation.norm();
    const double rate = std::sqrt(std::max(1 - zeta * zeta, 0.0));
    return std::hypot(deviation[0], (deviation[1] + zeta * deviation[0]) / rate);
}

// Bound on the change of the cubic force with u, as long as |u| stays below the gap.
double LastingMotionProof::lipschitz() const {
    const double reach = oscillator_.gap + (oscillator_.cubic_form == job::CubicForm::absolute ? 1 : 0);
    return 3 * std::abs(oscillator_.cubic) * reach * reach;
}

double LastingMotionProof::loop() const {
    return lipschitz() * gain(oscillator_.damping_ratio);
}

// A state that is close enough to an orbit that stays below the gap has a smaller amplitude about the steady
// motion without the cubic spring. On such an orbit the cubic force is a disturbance of that steady motion of
// less than lipschitz() times the gap, a third of it in the relative form, and its response has an amplitude of
// at most 1/(zeta sqrt(1 - zeta^2)) times that: by so much the orbit's largest |u| may be less than the steady
// motion's, and the state's amplitude about the orbit less than about the steady motion.
double LastingMotionProof::room_of_free_orbits() const {
    constexpr double rounding = 1e-6;
    const double zeta = oscillator_.damping_ratio;
    const double response = zeta < 0.99 ? 1 / (zeta * std::sqrt(1 - zeta * zeta)) : 2;
    const double gap = oscillator_.gap;
    const double shift = response * lipschitz() * std::abs(gap);
    return gap - free_flight_.amplitude() + 2 * shift + rounding * std::abs(gap);
}

bool LastingMotionProof::close_enough(const scene::State<double>& x, const FreeOrbit& orbit) const {
    const double room = oscillator_.gap - orbit.largest_displacement;
    return loop() < 1 && amplitude(x - orbit.point) < room * (1 - loop());
}

std::optional<SettledMotion> free_for_ever(const trajectory::FreeFlight<double>& flight,
                                           const scene::State<double>& x) {
    if (!flight.lasts(x)) return std::nullopt;
    const bool decays = flight.decays();
    return SettledMotion{flight.steady(), flight.jacobian(), 0,
                         decays ? flight.amplitude() : flight.largest_displacement(x), decays};
}

std::optional<SettledMotion> LastingMotionProof::stays_free(const scene::State<double>& x) {
    if (!may_stay_free_) return std::nullopt;
    if (oscillator_.cubic == 0) return free_for_ever(free_flight_, x);
    if (trajectory::phase_of(oscillator_, x) != trajectory::Phase::flight) return std::nullopt;
    const scene::State<double> deviation = x - steady_;
    // the first alone rejects most states, without a square root
    if (!(std::abs(deviation[0]) < room_ && amplitude(deviation) < room_)) return std::nullopt;
    const FreeOrbit* orbit = free_orbit();
    if (orbit == nullptr || !close_enough(x, *orbit)) return std::nullopt;
    return SettledMotion{orbit->point, orbit->jacobian, 0, orbit->largest_displacement};
}

LastingMotionProof::Contact LastingMotionProof::contact_of(const scene::Oscillator<double>& oscillator) {
    // The springs press on average only where the hammer's rest position lies behind the stop.
    if (oscillator.gap >= 0) return std::monostate{};
    if (oscillator.spring_dashpot() != nullptr) return trajectory::LinearContact<double>(oscillator);
    if (scene::is_rigid(oscillator.contact)) return trajectory::RigidContact<double>(oscillator);
    return std::monostate{};  // no proof without a closed form
}

bool LastingMotionProof::may_settle() {
    if (oscillator_.cubic == 0) return may_stay_free_ || may_stay_in_contact_;
    const FreeOrbit* orbit = free_orbit();
    return orbit == nullptr || orbit->largest_displacement < oscillator_.gap;
}

std::optional<SettledMotion> LastingMotionProof::stays_in_contact(const scene::State<double>& x) const {
    if (!may_stay_in_contact_) return std::nullopt;
    return std::visit(
        [&]<class Law>(const Law& contact) -> std::optional<SettledMotion> {
            if constexpr (!std::is_same_v<Law, std::monostate>) {
                if (!contact.lasts(x)) return std::nullopt;
                const bool decays = contact.decays();
                return SettledMotion{contact.steady(), contact.jacobian(),
                                     decays ? contact.steady_force() : contact.largest_force(x),
                                     contact.largest_displacement(x), decays};
            } else {
                return std::nullopt;
            }
        },
        contact_);
}

}  // namespace peterka::regime
