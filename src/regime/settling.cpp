#include "regime/settling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peterka::regime {

namespace {

scene::Oscillator<double> without_cubic(scene::Oscillator<double> scene) {
    scene.cubic = 0;
    return scene;
}

// Integral over all times of |impulse response| of the free hammer, u'' + 2 zeta u' + u.
double gain(double damping_ratio) {
    if (damping_ratio >= 1) return 1;
    return 1 / std::tanh(std::numbers::pi * damping_ratio / (2 * std::sqrt(1 - damping_ratio * damping_ratio)));
}

}  // namespace

Settling::Settling(const StroboscopicMap& map) : scene_(map.scene()), linear_(without_cubic(map.scene())) {
    if (scene_.cubic != 0) find_free_orbit(map);
}

void Settling::find_free_orbit(const StroboscopicMap& map) {
    const double amplitude = linear_.free_amplitude();
    if (!std::isfinite(amplitude)) return;
    // the same hammer with its stop out of reach
    scene::Oscillator<double> far = scene_;
    far.gap = 4 * (1 + amplitude);
    StroboscopicMap free_map = map.with_scene(far);
    const scene::State<double> start(linear_.steady_flight()[0] + scene_.gap - far.gap,
                                     linear_.steady_flight()[1]);
    const auto orbit = find_orbit(free_map, free_map.scaled(start), 1);
    if (!orbit || !(orbit->multiplier < 1)) return;
    Recorder<double> recorder;
    const Passage cycle = free_map.advance(orbit->point, 1, &recorder);
    if (!cycle.ok || cycle.touched) return;
    const scene::State<double> point = free_map.unscaled(orbit->point);
    free_orbit_ = {{point[0] + far.gap - scene_.gap, point[1]},
                   free_map.unscaled(orbit->jacobian),
                   recorder.totals().displacement_bound};
}

bool Settling::close_enough(const scene::State<double>& x) const {
    const double room = scene_.gap - free_orbit_->largest_displacement;
    if (!(room > 0)) return false;
    const scene::State<double> e = x - free_orbit_->point;
    // linear amplitude of e, by the energy where the motion doesn't oscillate
    const double zeta = scene_.damping_ratio;
    const double rate = std::sqrt(std::max(1 - zeta * zeta, 0.0));
    const double amplitude = zeta < 0.99 ? std::hypot(e[0], (e[1] + zeta * e[0]) / rate) : e.norm();
    const double reach = scene_.gap + (scene_.cubic_form == job::CubicForm::absolute ? 1 : 0);
    const double lipschitz = 3 * std::abs(scene_.cubic) * reach * reach;
    const double loop = lipschitz * gain(zeta);
    return loop < 1 && amplitude < room * (1 - loop);
}

std::optional<SettledMotion> Settling::stays_free(const scene::State<double>& x) const {
    if (scene_.cubic == 0) {
        if (!linear_.stays_free(x)) return std::nullopt;
        const bool decays = scene_.damping_ratio > 0;
        return SettledMotion{linear_.steady_flight(), linear_.flight_jacobian(), 0,
                             decays ? linear_.free_amplitude() : linear_.largest_free_displacement(x), decays};
    }
    if (!free_orbit_ || trajectory::phase_of(scene_, x) != trajectory::Phase::flight || !close_enough(x))
        return std::nullopt;
    return SettledMotion{free_orbit_->point, free_orbit_->jacobian, 0, free_orbit_->largest_displacement};
}

std::optional<SettledMotion> Settling::stays_in_contact(const scene::State<double>& x) const {
    if (scene_.cubic != 0 || !linear_.stays_in_contact(x)) return std::nullopt;
    const bool decays = scene_.damping_ratio > 0 || scene_.kelvin_voigt().damping > 0;
    return SettledMotion{linear_.steady_contact(), linear_.contact_jacobian(),
                         decays ? linear_.steady_contact_force() : linear_.largest_contact_force(x),
                         linear_.largest_contact_displacement(x), decays};
}

}  // namespace peterka::regime
