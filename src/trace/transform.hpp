// The Fourier integral of force and acceleration over a part of a motion, by quadrature on its smooth
// stretches.
//
//     integral of s(t) exp(-i w t) dt,   s: the force on the hammer, or the hammer's acceleration x''.
// Nothing is sampled evenly, so nothing is aliased, and jumps of the force at touch are where they are. Pieces
// of a stretch turn by at most 2 radians at the largest w and by 1 of the contact's own rate; eight
// Gauss-Legendre nodes are then exact to about 1e-12.
#pragma once

#include <complex>
#include <vector>

#include "trace/quantities.hpp"

namespace peterka::trace {

class Transform : public Watcher {
  public:
    // Of the motion between two times since the trace began; w up to largest_frequency, in omega.
    Transform(const scene::Oscillator<double>& scene, double from, double to, double largest_frequency);

    struct Integrals {
        std::complex<double> force;
        std::complex<double> acceleration;
    };
    // At w; times count from the beginning of the part.
    [[nodiscard]] Integrals at(double frequency) const;
    // At w = 0, step, 2 step, ..., (lines - 1) step.
    [[nodiscard]] std::vector<Integrals> on_grid(double step, std::int64_t lines) const;

  private:
    struct Node {
        double time;   // since the beginning of the part
        double force;  // times the node's weight
        double acceleration;
    };
    void look(const Stretch& stretch) override;
    void add_piece(const Stretch& stretch, double begin, double length);

    scene::Oscillator<double> scene_;
    double from_;
    double to_;
    double largest_frequency_;
    std::vector<Node> nodes_;
};

}  // namespace peterka::trace
