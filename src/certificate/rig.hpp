// Enclosures of the nondimensional numbers of one cell, as they follow exactly from the doubles of the job's
// resolved text and of the file's coordinates (meanings and equation: scene/oscillator.hpp).
#pragma once

#include <optional>

#include "certificate/interval.hpp"
#include "job/cell_numbers.hpp"

namespace peterka::certificate {

template <class Number>
struct RigOf {
    Number damping_ratio = 0;  // zeta
    Number stiffness = 0;      // kappa = ki/k
    Number damping = 0;        // chi = ci/(m omega)
    Number frequency = 0;      // eta
    Number gap = 0;            // g, in A0
    Number period = 0;         // 2 pi/eta
    Number cubic = 0;          // gamma = k3 A0^2/k
    bool absolute = false;     // the cubic term is that of x^3 - y^3, not u^3
    bool rigid = false;        // the stop reverses the velocity, delta' -> -r delta', and kappa = chi = 0
    Number restitution = 0;    // r
};
using Rig = RigOf<Interval>;

// Numbers within the enclosures, for a search that proves nothing.
[[nodiscard]] RigOf<double> middle(const Rig& rig);

// The rig of a spring-dashpot or a rigid stop; nothing for any other law. Number: Interval or Ball (ball.hpp).
template <class Number = Interval>
[[nodiscard]] std::optional<RigOf<Number>> rig_of(const job::CellNumbers& numbers);

// The hammer's start, x(0)/A0 and x'(0)/(A0 omega), absolute.
template <class Number>
struct EnclosedStart {
    Number displacement;
    Number velocity;
};
template <class Number = Interval>
[[nodiscard]] EnclosedStart<Number> start_of(const job::CellNumbers& numbers);

// The factors from F/(k A0) to F/(m g0), omega^2 A0/g0, and from A0 omega to m/s.
[[nodiscard]] Interval force_ratio(const job::CellNumbers& numbers);
[[nodiscard]] Interval speed_unit(const job::CellNumbers& numbers);
[[nodiscard]] Interval natural_frequency_hz(const job::CellNumbers& numbers);

}  // namespace peterka::certificate
