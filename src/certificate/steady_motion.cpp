#include "certificate/steady_motion.hpp"

#include "certificate/leg_proof.hpp"
#include "certificate/stability.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_steps_to_settle = 20'000;

// Of a delta + b delta' along the steady response: its mean, and how far it swings.
struct Swing {
    Interval mean;
    Interval amplitude;
};

Swing swing_of(const Phase<Interval>& phase, const Interval& a, const Interval& b) {
    const Interval sine = a * phase.real() - b * phase.frequency() * phase.imaginary();
    const Interval cosine = a * phase.imaginary() + b * phase.frequency() * phase.real();
    return {a * phase.rest(), sqrt(square(sine) + square(cosine))};
}

// The force, or in flight the penetration.
Swing swing_of(const Springs<Interval>& springs, bool presses) {
    const Phase<Interval>& phase = springs.phase(presses);
    return presses ? swing_of(phase, springs.rig.stiffness, springs.rig.damping)
                   : swing_of(phase, Interval(1), Interval(0));
}

// How near the signal comes to 0 at most.
Interval distance(const Swing& swing, bool presses) {
    return (presses ? swing.mean : -swing.mean) - swing.amplitude;
}

}  // namespace

std::optional<SteadyMotion> steady_motion(const Springs<Interval>& springs, bool presses) {
    const Swing swing = swing_of(springs, presses);
    if (!distance(swing, presses).positive()) return std::nullopt;
    const Phase<Interval>& phase = springs.phase(presses);
    const Matrix<Interval> flow = phase.flow(springs.rig.period);
    const double margin = stability_margin(exp(-(phase.damping() * springs.rig.period)), flow.a + flow.d);
    return SteadyMotion{presses ? swing.mean + swing.amplitude : Interval(0), margin};
}

// What decays has a length sqrt(x'^2 + K x^2) that never grows; once the signal can't change its sign by that,
// it never does.
bool keeps_to_phase(const Springs<Interval>& springs, bool presses, const Vector<Interval>& start) {
    const Phase<Interval>& phase = springs.phase(presses);
    const Interval room = distance(swing_of(springs, presses), presses);
    if (!room.positive()) return false;
    const Leg<Interval> leg(phase, Interval(0), start);
    const Interval weight =
        presses ? springs.rig.stiffness / sqrt(phase.stiffness()) + springs.rig.damping : Interval(1);
    const auto stays = [&](double offset) {
        const Vector<Interval> left = phase.flow(Interval(offset)) * leg.start().decaying;
        const Interval length = sqrt(square(left.velocity) + phase.stiffness() * square(left.position));
        return (weight * length).hi < room.lo;
    };
    const bool on_surface = start.position.lo == 0 && start.position.hi == 0;
    if (presses && !start.position.positive()) return false;
    March march(springs, leg, presses);
    double looked = 0;
    for (int steps = 0; steps < most_steps_to_settle; ++steps) {
        if (!march.step(1e6, steps == 0 && on_surface)) return false;
        if (march.offset() < looked + springs.rig.period.hi) continue;
        looked = march.offset();
        if (stays(looked)) return true;
    }
    return false;
}

}  // namespace peterka::certificate
