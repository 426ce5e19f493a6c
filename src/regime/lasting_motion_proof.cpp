#include "regime/lasting_motion_proof.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

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
      free_flight_(without_cubic(map.oscillator())),
      contact_(contact_of(without_cubic(map.oscillator()))) {
    if (oscillator_.cubic != 0) {
        find_free_orbit(map);
        may_stay_free_ = free_orbit_ && free_orbit_->largest_displacement < oscillator_.gap;
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

void LastingMotionProof::find_free_orbit(const StroboscopicMap& map) {
    const double amplitude = free_flight_.amplitude();
    if (!std::isfinite(amplitude)) return;
    // the same hammer with its stop out of reach
    scene::Oscillator<double> far = oscillator_;
    far.gap = 4 * (1 + amplitude);
    CycleBroker broker;
    StroboscopicMap free_map(far, map.settings(), broker);
    const scene::State<double> start(free_flight_.steady()[0] + oscillator_.gap - far.gap,
                                     free_flight_.steady()[1]);
    const auto orbit = complete(find_orbit(free_map, free_map.scaled(start), 1), broker);
    if (!orbit || !(orbit->multiplier < 1)) return;
    Recorder<double> recorder;
    const CycleResult cycle = complete(one_cycle(free_map, orbit->point(), recorder), broker);
    if (!cycle.ok || cycle.touched) return;
    const scene::State<double> point = free_map.unscaled(orbit->point());
    free_orbit_ = {{point[0] + far.gap - oscillator_.gap, point[1]},
                   free_map.unscaled(orbit->jacobian),
                   recorder.totals().displacement_bound};
}

bool LastingMotionProof::close_enough(const scene::State<double>& x) const {
    const double room = oscillator_.gap - free_orbit_->largest_displacement;
    const scene::State<double> e = x - free_orbit_->point;
    // linear amplitude of e, from the energy where the motion doesn't oscillate
    const double zeta = oscillator_.damping_ratio;
    const double rate = std::sqrt(std::max(1 - zeta * zeta, 0.0));
    const double amplitude = zeta < 0.99 ? std::hypot(e[0], (e[1] + zeta * e[0]) / rate) : e.norm();
    const double reach = oscillator_.gap + (oscillator_.cubic_form == job::CubicForm::absolute ? 1 : 0);
    const double lipschitz = 3 * std::abs(oscillator_.cubic) * reach * reach;
    const double loop = lipschitz * gain(zeta);
    return loop < 1 && amplitude < room * (1 - loop);
}

std::optional<SettledMotion> free_for_ever(const trajectory::FreeFlight<double>& flight,
                                           const scene::State<double>& x) {
    if (!flight.lasts(x)) return std::nullopt;
    const bool decays = flight.decays();
    return SettledMotion{flight.steady(), flight.jacobian(), 0,
                         decays ? flight.amplitude() : flight.largest_displacement(x), decays};
}

std::optional<SettledMotion> LastingMotionProof::stays_free(const scene::State<double>& x) const {
    if (!may_stay_free_) return std::nullopt;
    if (oscillator_.cubic == 0) return free_for_ever(free_flight_, x);
    if (trajectory::phase_of(oscillator_, x) != trajectory::Phase::flight || !close_enough(x))
        return std::nullopt;
    return SettledMotion{free_orbit_->point, free_orbit_->jacobian, 0, free_orbit_->largest_displacement};
}

LastingMotionProof::Contact LastingMotionProof::contact_of(const scene::Oscillator<double>& oscillator) {
    // The springs press on average only where the hammer's rest position lies behind the stop.
    if (oscillator.gap >= 0) return std::monostate{};
    if (oscillator.spring_dashpot() != nullptr) return trajectory::LinearContact<double>(oscillator);
    if (scene::is_rigid(oscillator.contact)) return trajectory::RigidContact<double>(oscillator);
    return std::monostate{};  // no proof without a closed form
}

bool LastingMotionProof::may_settle() const {
    if (oscillator_.cubic != 0 && !free_orbit_) return true;
    return may_stay_free_ || may_stay_in_contact_;
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
