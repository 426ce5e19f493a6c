// The rig at one place of the plane: the legs between events, and the events themselves, with all derivatives
// by frequency and gap in closed form. The cubic part of the springs is omitted.
//
//     delta'' + 2 b delta' + w2 delta = eta^2 sin(eta tau) - g,
// with b = zeta, w2 = 1 in flight, and b = zeta + chi/2, w2 = 1 + kappa while a spring-dashpot stop presses.
// A perturbation of the state is propagated by the leg's flow, which depends on its length alone, and at an
// event by its saltation matrix (Leine & Nijmeijer 2004; di Bernardo et al. 2008, ch. 2): [[1, 0], [-chi, 1]]
// at the touch of a spring-dashpot stop, [[-r, 0], [(1 + r) a/v, -r]] with a = eta^2 sin(theta) - g at that of
// a rigid one; the identity elsewhere.
#pragma once

#include <numbers>

#include "curves/orbit.hpp"
#include "motion/linear_motion.hpp"

namespace peterka::curves {

// The end state of a leg and its derivatives.
struct LegEnd {
    State<double> state;
    Jacobian<double> by_start;  // the flow
    State<double> by_start_time;
    State<double> by_end_time;
    State<double> by_frequency;
    State<double> by_gap;
};

struct Change {  // a saltation matrix and its derivatives
    Jacobian<double> value = Jacobian<double>::Identity();
    Jacobian<double> by_time = Jacobian<double>::Zero();
    Jacobian<double> by_velocity = Jacobian<double>::Zero();
    Jacobian<double> by_frequency = Jacobian<double>::Zero();
    Jacobian<double> by_gap = Jacobian<double>::Zero();
};

// Derivatives of frequency and gap by the coordinates of a place.
struct PlaceSlopes {
    double frequency_by_column = 1;
    double gap_by_column = 0;
    double frequency_by_row = 0;
    double gap_by_row = 1;
};

class PlacedRig {
  public:
    // Spring-dashpot or rigid stops only.
    explicit PlacedRig(const scene::Oscillator<double>& oscillator, const PlaceSlopes& slopes = {});

    [[nodiscard]] bool is_rigid() const { return rigid_; }
    [[nodiscard]] const scene::Oscillator<double>& oscillator() const { return oscillator_; }
    [[nodiscard]] double frequency() const { return oscillator_.frequency; }
    [[nodiscard]] double gap() const { return oscillator_.gap; }
    // Duration of q forcing cycles, in tau.
    [[nodiscard]] double duration_of(std::int64_t period) const {
        return 2 * std::numbers::pi * static_cast<double>(period) / frequency();
    }
    // Chain rule: the derivative by a coordinate of the place, from those by frequency and gap.
    template <class Value>
    [[nodiscard]] Value by_column(const Value& by_frequency, const Value& by_gap) const {
        return by_frequency * slopes_.frequency_by_column + by_gap * slopes_.gap_by_column;
    }
    template <class Value>
    [[nodiscard]] Value by_row(const Value& by_frequency, const Value& by_gap) const {
        return by_frequency * slopes_.frequency_by_row + by_gap * slopes_.gap_by_row;
    }

    // b and w2 of the equation above.
    [[nodiscard]] double damping(bool presses) const {
        return presses ? contact_damping_ : oscillator_.damping_ratio;
    }
    [[nodiscard]] double stiffness(bool presses) const { return presses ? 1 + kappa_ : 1; }
    // The time derivative of a state.
    [[nodiscard]] State<double> slope(bool presses, double time, const State<double>& x) const;
    // f in k A0, as if the stop pressed.
    [[nodiscard]] double force(const State<double>& x) const { return kappa_ * x[0] + chi_ * x[1]; }

    // The states on an event's surface: the end of the leg before it, and the start of the leg after it.
    [[nodiscard]] State<double> arrival(const Event& event) const {
        return {surface(event.kind) * event.velocity, event.velocity};
    }
    [[nodiscard]] State<double> departure(const Event& event) const {
        const double kept = rigid_ && event.kind == EventKind::touch ? -restitution_ : 1;
        return {surface(event.kind) * event.velocity, kept * event.velocity};
    }
    // Derivatives of both by the velocity.
    [[nodiscard]] State<double> arrival_by_velocity(EventKind kind) const { return {surface(kind), 1}; }
    [[nodiscard]] State<double> departure_by_velocity(EventKind kind) const {
        return {surface(kind), rigid_ && kind == EventKind::touch ? -restitution_ : 1};
    }

    [[nodiscard]] LegEnd leg(bool presses, double from, const State<double>& start, double to) const;
    [[nodiscard]] State<double> state_in_leg(bool presses, double from, const State<double>& start,
                                             double to) const;
    [[nodiscard]] Jacobian<double> flow(bool presses, double length) const;
    // At a touch, or at a grazing that counts as an impact just beginning (spring-dashpot stops). For a rigid
    // stop the matrix is multiplied by the impact's speed over `speed`, so that it has a limit at a grazing.
    [[nodiscard]] Change saltation(const Event& event, bool grazing_counts, double speed) const;
    // Determinant of the product of an impact's saltation matrices.
    [[nodiscard]] double determinant_of_touch() const { return rigid_ ? restitution_ * restitution_ : 1; }

  private:
    // delta = surface * delta'
    [[nodiscard]] double surface(EventKind kind) const {
        return kind == EventKind::release || kind == EventKind::resume ? -chi_ / kappa_ : 0;
    }

    scene::Oscillator<double> oscillator_;
    PlaceSlopes slopes_;
    bool rigid_ = false;
    double restitution_ = 0;
    double kappa_ = 0;
    double chi_ = 0;
    double contact_damping_ = 0;
    motion::LinearMotion<double> flight_;  // for their flows, which depend on neither frequency nor gap
    motion::LinearMotion<double> contact_;
};

}  // namespace peterka::curves
