// The cells of a batch as a structure of arrays: one lane per cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace peterka::batch {

constexpr std::size_t widest_vector = 16;  // lanes that the kernel takes at once, at most
constexpr double never = 1e9;              // as a grid point: the lane takes no part in this cycle

// The arrays of a batch, a number for each lane. Grid point n is the forcing phase 2 pi n/steps.
enum class Field : std::uint8_t {
    // The cell. Its gap decides these,
    gap,
    static_position,  // of the flight, as delta
    forced_delta_constant,
    forced_velocity_constant,

    // and its frequency the others; with a cubic spring both decide all of them. Harmonic responses are u =
    // Im(response exp(i theta)) in flight and contact.
    frequency,
    step,  // tau from grid point to grid point
    flight_re,
    flight_im,
    swing,  // |flight response|
    contact_re,
    contact_im,
    contact_swing,
    // with a cubic spring: the linear equations' own (see flight-inl.hpp), and by how much a change of the
    // velocity raises the margin of the flag test
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

    // The state at the current grid point and at the next; which of the two is which alternates.
    delta_0,
    delta_1,
    velocity_0,
    velocity_1,
    in_use,  // 1, or 0: another engine's or nobody's
    next,    // grid point from which the lane is in flight again
    margin,  // of the flag test: what a step's cubic may be wrong by, over s^2 (1 - s)^2, over 6
    start_delta,
    start_velocity,
    leg_start,      // tau at which the present leg began
    leg_amplitude,  // of its homogeneous part, then
    leg_energy,     // hypot(u, u'), then

    // What the cycle did.
    impacts,
    touched,
    separated,
    peak_force,
    largest_displacement,
    jacobian_00,
    jacobian_01,
    jacobian_10,
    jacobian_11,

    // The cell's rig, where rigs differ.
    damping_ratio,
    cubic,
    stiffness,
    damping,
};
constexpr std::size_t index_of(Field field) {
    return static_cast<std::size_t>(field);
}
constexpr Field after(Field field, std::size_t places) {
    return static_cast<Field>(index_of(field) + places);
}
constexpr std::size_t fields = index_of(Field::jacobian_11) + 1;
constexpr std::size_t fields_with_rigs = index_of(Field::damping) + 1;
// Those that don't change from cycle to cycle: the first of them depend on the gap always.
constexpr std::size_t gap_fields = index_of(Field::frequency);
constexpr std::size_t cell_fields = index_of(Field::delta_0);

struct Lanes {
    std::size_t size = 0;  // lanes in use; those that fill the last vector are idle
    std::array<double*, fields_with_rigs> arrays{};
    std::uint64_t* pattern = nullptr;  // of the cycle's events

    double* operator[](Field field) const { return arrays[index_of(field)]; }
    [[nodiscard]] double* delta(std::size_t which) const { return (*this)[after(Field::delta_0, which)]; }
    [[nodiscard]] double* velocity(std::size_t which) const { return (*this)[after(Field::velocity_0, which)]; }
    // Row by row.
    [[nodiscard]] double* jacobian(std::size_t n) const { return (*this)[after(Field::jacobian_00, n)]; }
};

// Moments of lanes that wait for the same treatment.
struct Queue {
    explicit Queue(std::size_t lanes)
        : lane(lanes + 2 * widest_vector),
          end(lane.size()),
          time(lane.size()),
          delta(lane.size()),
          velocity(lane.size()),
          sine(lane.size()),
          cosine(lane.size()) {}

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

    std::size_t size = 0;
    std::vector<std::int64_t> lane;
    std::vector<double> end;   // grid point up to which it was already followed
    std::vector<double> time;  // tau since the cycle began
    std::vector<double> delta;
    std::vector<double> velocity;
    std::vector<double> sine;  // of the forcing's phase
    std::vector<double> cosine;
};

// Lanes that cross the stop within the present step.
struct Crossings {
    explicit Crossings(std::size_t lanes) : lane(lanes + 2 * widest_vector) {}
    std::size_t size = 0;
    std::vector<std::int64_t> lane;
};

struct Queues {
    explicit Queues(std::size_t lanes)
        : crossings(lanes),
          hops(lanes),
          contacts(lanes),
          releases(lanes),
          turns(lanes),
          held_contacts(lanes),
          held_releases(lanes),
          twin(lanes) {}
    Crossings crossings;  // above the stop at the end of a step
    Queue hops;           // may rise above it within a stretch of flight
    Queue contacts;       // of any length
    Queue releases;       // above the stop, which doesn't press
    Queue turns;          // the same, but they leave slowly
    Queue held_contacts;  // with a cubic spring: those that wait for the kick at a grid point
    Queue held_releases;
    Crossings twin;  // left to the scalar engine in this cycle
};

// The forcing's phases at the grid points.
struct Grid {
    explicit Grid(int steps_per_cycle);
    int steps;
    std::vector<double> sine;
    std::vector<double> cosine;
};

struct Wanted {
    bool measure = false;   // peak force and a bound of |u|
    bool jacobian = false;  // of the cycle
};

}  // namespace peterka::batch
