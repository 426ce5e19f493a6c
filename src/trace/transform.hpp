// The Fourier integral of force and acceleration over part of a motion, by quadrature on its smooth stretches.
//
//     integral of s(t) exp(-i w t) dt,   s: the force on the hammer, or the hammer's acceleration x''.
// Nothing is sampled evenly, so nothing is aliased, and jumps of the force at touch are located exactly. Pieces
// of a stretch turn by at most 2 radians at the largest w and by 1 at the contact's own rate; eight
// Gauss-Legendre nodes are then exact to about 1e-12. A rigid stop acts by impulses: each impact adds its own.
#pragma once

#include <complex>
#include <vector>

#include "trace/quantities.hpp"

namespace peterka::trace {

class Transform : public Watcher {
  public:
    // For the motion between two times since the trace began, at w = 0, step, 2 step, ..., (lines - 1) step, in
    // omega.
    Transform(const scene::Oscillator<double>& oscillator, double from, double to, double step,
              std::int64_t lines);

    struct Integrals {
        std::complex<double> force;
        std::complex<double> acceleration;
    };
    // Line by line; times count from the beginning of the part.
    [[nodiscard]] const std::vector<Integrals>& lines() const { return lines_; }

    void touch(double speed) override;

  private:
    // A value at a time since the beginning of the part, times its weight.
    struct Node {
        double time;
        double force;
        double acceleration;
    };
    void look(const Stretch& stretch) override;
    void add_piece(const Stretch& stretch, double begin, double length);
    void add(const Node& node);

    scene::Oscillator<double> oscillator_;
    double from_;
    double to_;
    double step_;
    std::vector<Integrals> lines_;
};

}  // namespace peterka::trace
