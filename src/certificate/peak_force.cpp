#include "certificate/peak_force.hpp"

#include <algorithm>
#include <cmath>

#include "certificate/bends.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_pieces = 20'000;

// The force and its derivatives at a moment of a contact.
struct Force {
    Interval value;
    Interval slope;
    Interval curvature;
};

class ContactPeak {
  public:
    ContactPeak(const Springs<Interval>& springs, const Leg<Interval>& leg, double length, Interval& largest)
        : springs_(springs), leg_(leg), length_(length), largest_(largest) {}

    // Includes the largest force of the contact. False: it took too many pieces.
    [[nodiscard]] bool bound() {
        std::vector<Piece> waiting{{0, length_}};
        for (int pieces = 0; !waiting.empty(); ++pieces) {
            if (pieces == most_pieces) return false;
            const Piece piece = waiting.back();
            waiting.pop_back();
            if (is_done(piece)) continue;
            const double middle = 0.5 * (piece.from + piece.to);
            if (!(piece.from < middle && middle < piece.to)) return false;
            waiting.push_back({middle, piece.to});
            waiting.push_back({piece.from, middle});
        }
        return true;
    }

  private:
    struct Piece {
        double from;
        double to;
    };

    [[nodiscard]] Force at(const Moment<Interval>& moment) const {
        const Vector<Interval>& state = moment.state;
        const Interval acceleration = leg_.phase().acceleration(state, moment.angle.sine);
        const Interval jerk = leg_.phase().jerk(state, acceleration, moment.angle);
        return {springs_.force(state), springs_.force({state.velocity, acceleration}),
                springs_.force({acceleration, jerk})};
    }

    void raise(const Interval& force) { largest_ = larger(largest_, force); }

    // Whether the piece needs no further subdivision.
    bool is_done(const Piece& piece) {
        const double middle = 0.5 * (piece.from + piece.to);
        const double half = up(std::max(up(piece.to - middle), up(middle - piece.from)));
        if (!(half <= short_time(leg_.phase()))) return false;  // otherwise the bounds are poor or invalid
        const Moment<Interval> moment = leg_.at(Interval(middle));
        const Force force = at(moment);
        const Bends near = bends(leg_.phase(), moment, half, Within::both_ways);
        const double bend = near.of_slope(springs_.rig);
        const Interval sides(-half, half);
        const Interval curvature = force.curvature + Interval(bend) * sides;
        const Interval slope = force.slope + curvature * sides;
        if (slope.positive() || slope.negative()) return true;
        if ((force.value + slope * sides).hi < largest_.lo) return true;
        if (!curvature.negative()) return false;
        return touch_from_above(piece, middle - force.slope.middle() / force.curvature.middle());
    }

    // A concave piece, whose largest force is near the offset.
    bool touch_from_above(const Piece& piece, double offset) {
        for (int steps = 0; steps < 4; ++steps) {
            offset = std::clamp(offset, piece.from, piece.to);
            const Force force = at(leg_.at(Interval(offset)));
            const Interval reach = Interval(piece.to) - piece.from;
            const Interval above = force.value + Interval(0, (abs(force.slope) * reach).hi);
            const double next = offset - force.slope.middle() / force.curvature.middle();
            const bool is_best = std::abs(force.slope.middle()) <= 4 * force.slope.radius();
            const bool is_outside = next < piece.from || next > piece.to;
            if (!is_best && is_outside && reach.hi > 1e-6 * length_) return false;
            if (is_best || is_outside || steps == 3) {
                raise(above);
                return true;
            }
            offset = next;
        }
        return false;
    }

    const Springs<Interval>& springs_;
    const Leg<Interval>& leg_;
    double length_;
    Interval& largest_;
};

}  // namespace

Interval peak_force(const Springs<Interval>& springs, const EventChain& chain,
                    const std::vector<Place<Interval>>& places) {
    Interval largest(0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (chain.events[i].kind == EventKind::touch) {
            largest = larger(largest, springs.rig.damping * places[i].along);
        }
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!chain.presses(i)) continue;
        const auto [leg, length] = leg_of(springs, chain, places, i);
        ContactPeak contact(springs, leg, length.hi, largest);
        if (!contact.bound()) return nothing();
    }
    return largest;
}

}  // namespace peterka::certificate
