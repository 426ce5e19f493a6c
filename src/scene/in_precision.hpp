// A scene in another number type: the same numbers, to the last bit of the coarser type.
#pragma once

#include <variant>

#include "scene/oscillator.hpp"

namespace peterka::scene {

template <class To, class From>
Oscillator<To> in_precision(const Oscillator<From>& scene) {
    return {.damping_ratio = static_cast<To>(scene.damping_ratio),
            .contact = std::visit([](const auto& law) { return ContactLaw<To>(law.template as<To>()); },
                                  scene.contact),
            .frequency = static_cast<To>(scene.frequency),
            .gap = static_cast<To>(scene.gap),
            .cubic = static_cast<To>(scene.cubic),
            .cubic_form = scene.cubic_form};
}

}  // namespace peterka::scene
