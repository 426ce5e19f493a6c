#include "certificate/rig.hpp"

#include <variant>

#include "certificate/ball.hpp"
#include "certificate/elementary.hpp"

namespace peterka::certificate {
namespace {

constexpr Interval standard_gravity{0x1.39d013a92a305p+3, 0x1.39d013a92a306p+3};  // 9.80665 m/s^2

template <class Number>
Number omega_of(const job::Hammer& hammer) {  // [rad/s]
    if (hammer.natural_frequency_hz) return Number(2) * Constants<Number>::pi() * *hammer.natural_frequency_hz;
    return sqrt(Number(hammer.stiffness_n_per_m.value()) / hammer.mass_kg);
}

template <class Number>
Number stiffness_of(const job::Hammer& hammer) {  // k [N/m]
    if (hammer.stiffness_n_per_m) return *hammer.stiffness_n_per_m;
    return Number(hammer.mass_kg) * square(omega_of<Number>(hammer));
}

}  // namespace

RigOf<double> middle(const Rig& rig) {
    return {rig.damping_ratio.middle(), rig.stiffness.middle(), rig.damping.middle(),
            rig.frequency.middle(),     rig.gap.middle(),       rig.period.middle(),
            rig.cubic.middle(),         rig.absolute,           rig.rigid,
            rig.restitution.middle()};
}

template <class Number>
std::optional<RigOf<Number>> rig_of(const job::CellNumbers& numbers) {
    const auto* stop = std::get_if<job::KelvinVoigt>(&numbers.contact);
    const auto* rigid = std::get_if<job::Restitution>(&numbers.contact);
    if (stop == nullptr && rigid == nullptr) return std::nullopt;
    const job::Hammer& hammer = numbers.hammer;
    const auto omega = omega_of<Number>(hammer);
    const Number impedance = Number(hammer.mass_kg) * omega;  // m omega [Ns/m]
    RigOf<Number> rig;
    rig.damping_ratio = hammer.damping_ratio
                            ? Number(*hammer.damping_ratio)
                            : Number(hammer.damping_ns_per_m.value()) / (Number(2) * impedance);
    if (stop != nullptr) {
        rig.stiffness = Number(stop->stiffness_n_per_m) / stiffness_of<Number>(hammer);
        rig.damping = Number(stop->damping_ns_per_m) / impedance;
    } else {
        rig.rigid = true;
        rig.restitution = rigid->coefficient;
    }
    rig.frequency = numbers.place.frequency_hz
                        ? Number(2) * Constants<Number>::pi() * *numbers.place.frequency_hz / omega
                        : Number(numbers.place.frequency_ratio);
    rig.gap = numbers.place.gap_m ? Number(*numbers.place.gap_m) / numbers.cart.amplitude_m
                                  : Number(numbers.place.gap_ratio);
    rig.period = Number(2) * Constants<Number>::pi() / rig.frequency;
    if (hammer.cubic_stiffness_n_per_m3 != 0) {
        rig.cubic = square(Number(numbers.cart.amplitude_m)) * hammer.cubic_stiffness_n_per_m3 /
                    stiffness_of<Number>(hammer);
        rig.absolute = hammer.cubic == job::CubicForm::absolute;
    }
    return rig;
}

template <class Number>
EnclosedStart<Number> start_of(const job::CellNumbers& numbers) {
    const job::Start& start = numbers.start;
    const Number amplitude(numbers.cart.amplitude_m);
    return {start.displacement_m ? Number(*start.displacement_m) / amplitude : Number(start.displacement_ratio),
            start.velocity_m_per_s
                ? Number(*start.velocity_m_per_s) / (amplitude * omega_of<Number>(numbers.hammer))
                : Number(start.velocity_ratio)};
}

template std::optional<Rig> rig_of(const job::CellNumbers&);
template std::optional<RigOf<Ball>> rig_of(const job::CellNumbers&);
template EnclosedStart<Interval> start_of(const job::CellNumbers&);
template EnclosedStart<Ball> start_of(const job::CellNumbers&);

Interval force_ratio(const job::CellNumbers& numbers) {
    return square(omega_of<Interval>(numbers.hammer)) * numbers.cart.amplitude_m / standard_gravity;
}

Interval speed_unit(const job::CellNumbers& numbers) {
    return omega_of<Interval>(numbers.hammer) * numbers.cart.amplitude_m;
}

Interval natural_frequency_hz(const job::CellNumbers& numbers) {
    return omega_of<Interval>(numbers.hammer) / (Interval(2) * pi);
}

}  // namespace peterka::certificate
