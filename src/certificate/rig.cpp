#include "certificate/rig.hpp"

#include <variant>

#include "certificate/elementary.hpp"

namespace peterka::certificate {
namespace {

constexpr Interval standard_gravity{0x1.39d013a92a305p+3, 0x1.39d013a92a306p+3};  // 9.80665 m/s^2

Interval omega_of(const job::Hammer& hammer) {  // [rad/s]
    if (hammer.natural_frequency_hz) return Interval(2) * pi * *hammer.natural_frequency_hz;
    return sqrt(Interval(hammer.stiffness_n_per_m.value()) / hammer.mass_kg);
}

Interval stiffness_of(const job::Hammer& hammer) {  // k [N/m]
    if (hammer.stiffness_n_per_m) return *hammer.stiffness_n_per_m;
    return Interval(hammer.mass_kg) * square(omega_of(hammer));
}

}  // namespace

RigOf<double> middle(const Rig& rig) {
    return {rig.damping_ratio.middle(), rig.stiffness.middle(), rig.damping.middle(),
            rig.frequency.middle(),     rig.gap.middle(),       rig.period.middle(),
            rig.cubic.middle(),         rig.absolute,           rig.rigid,
            rig.restitution.middle()};
}

std::optional<Rig> rig_of(const job::CellNumbers& numbers) {
    const auto* stop = std::get_if<job::KelvinVoigt>(&numbers.contact);
    const auto* rigid = std::get_if<job::Restitution>(&numbers.contact);
    if (stop == nullptr && rigid == nullptr) return std::nullopt;
    const job::Hammer& hammer = numbers.hammer;
    const Interval omega = omega_of(hammer);
    const Interval impedance = Interval(hammer.mass_kg) * omega;  // m omega [Ns/m]
    Rig rig;
    rig.damping_ratio = hammer.damping_ratio
                            ? Interval(*hammer.damping_ratio)
                            : Interval(hammer.damping_ns_per_m.value()) / (Interval(2) * impedance);
    if (stop != nullptr) {
        rig.stiffness = Interval(stop->stiffness_n_per_m) / stiffness_of(hammer);
        rig.damping = Interval(stop->damping_ns_per_m) / impedance;
    } else {
        rig.rigid = true;
        rig.restitution = rigid->coefficient;
    }
    rig.frequency = numbers.place.frequency_hz ? Interval(2) * pi * *numbers.place.frequency_hz / omega
                                               : Interval(numbers.place.frequency_ratio);
    rig.gap = numbers.place.gap_m ? Interval(*numbers.place.gap_m) / numbers.cart.amplitude_m
                                  : Interval(numbers.place.gap_ratio);
    rig.period = Interval(2) * pi / rig.frequency;
    if (hammer.cubic_stiffness_n_per_m3 != 0) {
        rig.cubic =
            square(Interval(numbers.cart.amplitude_m)) * hammer.cubic_stiffness_n_per_m3 / stiffness_of(hammer);
        rig.absolute = hammer.cubic == job::CubicForm::absolute;
    }
    return rig;
}

EnclosedStart start_of(const job::CellNumbers& numbers) {
    const job::Start& start = numbers.start;
    const Interval amplitude(numbers.cart.amplitude_m);
    return {
        start.displacement_m ? Interval(*start.displacement_m) / amplitude : Interval(start.displacement_ratio),
        start.velocity_m_per_s ? Interval(*start.velocity_m_per_s) / (amplitude * omega_of(numbers.hammer))
                               : Interval(start.velocity_ratio)};
}

Interval force_ratio(const job::CellNumbers& numbers) {
    return square(omega_of(numbers.hammer)) * numbers.cart.amplitude_m / standard_gravity;
}

Interval speed_unit(const job::CellNumbers& numbers) {
    return omega_of(numbers.hammer) * numbers.cart.amplitude_m;
}

Interval natural_frequency_hz(const job::CellNumbers& numbers) {
    return omega_of(numbers.hammer) / (Interval(2) * pi);
}

}  // namespace peterka::certificate
