// An oscillator in another number type: the same numbers, to the last bit of the coarser type.
#pragma once

#include <variant>

#include "scene/oscillator.hpp"

namespace peterka::scene {

template <class To, class From>
Oscillator<To> in_precision(const Oscillator<From>& oscillator) {
    return {.damping_ratio = static_cast<To>(oscillator.damping_ratio),
            .contact = std::visit([](const auto& law) { return ContactLaw<To>(law.template as<To>()); },
                                  oscillator.contact),
            .frequency = static_cast<To>(oscillator.frequency),
            .gap = static_cast<To>(oscillator.gap),
            .cubic = static_cast<To>(oscillator.cubic),
            .cubic_form = oscillator.cubic_form};
}

}  // namespace peterka::scene
