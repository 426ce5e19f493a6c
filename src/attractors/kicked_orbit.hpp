// A settled motion whose velocity changes suddenly at some moment of its period, and its state when the forcing
// next passes phase 0, from which a search continues.
#pragma once

#include <optional>
#include <vector>

#include "regime/attractor_table.hpp"
#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::attractors {

struct KickTried {
    double phase = 0;   // forcing cycles after phase 0 of the orbit's first point
    double change = 0;  // of the hammer's velocity, in A0 omega; positive towards the stop
    [[nodiscard]] double size() const { return change < 0 ? -change : change; }
};

class KickedOrbit {
  public:
    // A motion that the engine carried on, or why it could not: `not_finite` where it escapes.
    struct Carried {
        trajectory::Cycle<double>::Outcome outcome = trajectory::Cycle<double>::Outcome::done;
        scene::State<double> state;
        [[nodiscard]] bool done() const { return outcome == trajectory::Cycle<double>::Outcome::done; }
    };

    // found: an attractor that has an orbit, with the engine that found it.
    KickedOrbit(scene::Oscillator<double> oscillator, const regime::FoundAttractor& found);

    [[nodiscard]] int period() const { return static_cast<int>(points_.size()); }

    // The state at the next forcing phase 0.
    [[nodiscard]] Carried after(const KickTried& kick);
    // The state at the end of the orbit's period, where the orbit passes its first point; nothing where the
    // engine cannot carry it there.
    [[nodiscard]] std::optional<scene::State<double>> round(const KickTried& kick);

  private:
    Carried carry(const scene::State<double>& from, double begin, double end);

    double length_;  // of a cycle, in tau
    regime::CycleMap map_;
    std::vector<scene::State<double>> points_;  // at phase 0
};

}  // namespace peterka::attractors
