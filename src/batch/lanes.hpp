// The cells of a batch as a structure of arrays: one lane per cell.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace peterka::batch {

constexpr std::size_t widest_vector = 16;  // largest number of lanes that the kernel processes at once
constexpr double never = 1e9;              // as a grid point: beyond all others

// The law of the stop and springs: spring and dashpot; the same with the kicks of a cubic spring; or a rigid
// stop.
enum class Law : std::uint8_t { spring_dashpot, kicks, rigid };

// The arrays of a batch, with a number for each lane. Grid point n is the forcing phase 2 pi n/steps.
enum class Field : std::uint8_t {
    // The cell. These depend on its gap,
    gap,
    static_position,  // of the flight, as delta
    forced_delta_constant,
    forced_velocity_constant,

    // and the others on its frequency; with a cubic spring all depend on both. Harmonic responses are u =
    // Im(response exp(i theta)) in flight and contact.
    frequency,
    step,  // tau between grid points
    flight_re,
    flight_im,
    swing,  // |flight response|
    contact_re,
    contact_im,
    contact_swing,
    // with a cubic spring: each cell's own linear equations (flight-inl.hpp), and the increase of the flag
    // test's margin per change of the velocity
    flight_square,
    flight_rate,
    contact_rate,
    margin_per_speed,
    // One step of free flight: (delta, delta') -> E (delta, delta') + forced, the latter affine in the
    // sine and cosine of the forcing's phase at the step's start.
    e00,
    e01,
    e10,
    e11,
    forced_delta_sine,
    forced_delta_cosine,
    forced_velocity_sine,
    forced_velocity_cosine,

    // The state at the lane's grid point, and at the beginning of its last step of flight.
    delta,
    velocity,
    delta_before,
    velocity_before,
    next,    // grid point of a lane in flight; `never` while an event holds it; the last, or beyond, at its end
    margin,  // of the flag test: error bound of a step's cubic, over 6 s^2 (1 - s)^2
    start_delta,
    start_velocity,
    leg_start,      // tau at the beginning of the present leg
    leg_amplitude,  // amplitude of its homogeneous part at that time
    leg_energy,     // hypot(u, u') at that time

    // The results of the cycle.
    impacts,
    touched,
    separated,
    peak_force,
    largest_displacement,
    jacobian_00,
    jacobian_01,
    jacobian_10,
    jacobian_11,

    // The cell's rig, if rigs differ.
    damping_ratio,
    cubic,
    stiffness,
    damping,
    restitution,

    // With a rigid stop (trajectory/rigid_stop.hpp): the phases between which the stop presses a hammer at
    // rest, from the first on, or up to the second, or both where the first is less.
    press_from,
    press_to,
    // The impacts of the present stretch of pressing, as far as they lie in this cycle
    // (trajectory/rigid_impact.hpp).
    chain_until,    // phase at which the stretch is over
    chain_impacts,  // of the cycle, when the stretch began
    chain_impulse,  // of its impacts
    // The results of the cycle.
    swallowed,  // impacts that belong to a completed chatter, less one for each chatter
    chatter,
    impact_speed,  // as trajectory::Totals
    impulse,
    contact_time,
    contact_work,
};
constexpr std::size_t index_of(Field field) {
    return static_cast<std::size_t>(field);
}
constexpr Field after(Field field, std::size_t places) {
    return static_cast<Field>(index_of(field) + places);
}
constexpr std::size_t fields = index_of(Field::jacobian_11) + 1;
constexpr std::size_t fields_with_rigs = index_of(Field::restitution) + 1;
constexpr std::size_t fields_of_rigid_stops = index_of(Field::contact_work) + 1;
// The number of constant fields; the first gap_fields always depend on the gap.
constexpr std::size_t gap_fields = index_of(Field::frequency);
constexpr std::size_t cell_fields = index_of(Field::delta);

struct Lanes {
    std::size_t size = 0;  // lanes in use; those that pad the last vector are idle
    std::array<double*, fields_of_rigid_stops> arrays{};
    std::uint64_t* pattern = nullptr;        // of the cycle's events
    std::uint64_t* chain_pattern = nullptr;  // with a rigid stop: at the beginning of the chain

    double* operator[](Field field) const { return arrays[index_of(field)]; }
    // Row by row.
    [[nodiscard]] double* jacobian(std::size_t n) const { return (*this)[after(Field::jacobian_00, n)]; }
};

// The moments of lanes that wait for the same treatment.
struct Queue {
    // Reserves space for `lanes` lanes; the entries stay.
    void make_room(std::size_t lanes) {
        lane.resize(lanes + 2 * widest_vector);
        for (auto* field : {&end, &time, &delta, &velocity, &sine, &cosine}) field->resize(lane.size());
    }

    struct Entry {
        double end, time, delta, velocity, sine, cosine;
    };
    void add(std::int64_t which, const Entry& entry) {
        lane[size] = which;
        end[size] = entry.end;
        time[size] = entry.time;
        delta[size] = entry.delta;
        velocity[size] = entry.velocity;
        sine[size] = entry.sine;
        cosine[size] = entry.cosine;
        ++size;
    }
    // Renames the lane of an entry.
    void rename(std::int64_t which, std::int64_t to) {
        std::replace(lane.begin(), lane.begin() + static_cast<std::ptrdiff_t>(size), which, to);
    }

    std::size_t size = 0;
    int passes = 0;  // rounds of the march since lanes were last taken
    std::vector<std::int64_t> lane;
    std::vector<double> end;   // grid point up to which the lane is to be followed, or has been
    std::vector<double> time;  // tau since the cycle began
    std::vector<double> delta;
    std::vector<double> velocity;
    std::vector<double> sine;  // of the forcing's phase
    std::vector<double> cosine;
};

// A list of lanes without moments.
struct LaneList {
    std::size_t size = 0;
    std::vector<std::int64_t> lane;
};

struct Queues {
    void make_room(std::size_t lanes) {
        for (Queue* queue : events()) queue->make_room(lanes);
        twin.lane.resize(lanes + 2 * widest_vector);
    }
    Queue crossings;      // above the stop at the end of a step
    Queue hops;           // may rise above it within a stretch of flight
    Queue contacts;       // of any length; on a rigid stop, at rest
    Queue releases;       // above the stop, which does not press
    Queue turns;          // the same, but leaving slowly; with a rigid stop: leaving and soon back
    Queue held_contacts;  // with a cubic spring: waiting for the kick at a grid point
    Queue held_releases;
    [[nodiscard]] std::array<Queue*, 7> events() {
        return {&crossings, &hops, &contacts, &releases, &turns, &held_contacts, &held_releases};
    }
    LaneList twin;  // left to the scalar engine in this cycle
};

// The forcing's phases at the grid points.
struct Grid {
    explicit Grid(int steps_per_cycle);
    int steps;
    std::vector<double> sine;
    std::vector<double> cosine;
};

}  // namespace peterka::batch
