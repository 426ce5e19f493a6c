// A scene in another number type: the same numbers, to the last bit of the coarser type.
#pragma once

#include <variant>

#include "scene/oscillator.hpp"

namespace peterka::scene {

template <class To, class From>
KelvinVoigt<To> in_precision(const KelvinVoigt<From>& law) {
    return {static_cast<To>(law.stiffness), static_cast<To>(law.damping)};
}

template <class To, class From>
Restitution<To> in_precision(const Restitution<From>& law) {
    return {static_cast<To>(law.coefficient)};
}

template <class To, class From>
HuntCrossley<To> in_precision(const HuntCrossley<From>& law) {
    return {static_cast<To>(law.stiffness), static_cast<To>(law.exponent), static_cast<To>(law.dissipation)};
}

template <class To, class From>
Oscillator<To> in_precision(const Oscillator<From>& scene) {
    return {.damping_ratio = static_cast<To>(scene.damping_ratio),
            .contact = std::visit([](const auto& law) { return ContactLaw<To>(in_precision<To>(law)); },
                                  scene.contact),
            .frequency = static_cast<To>(scene.frequency),
            .gap = static_cast<To>(scene.gap),
            .cubic = static_cast<To>(scene.cubic),
            .cubic_form = scene.cubic_form};
}

}  // namespace peterka::scene
