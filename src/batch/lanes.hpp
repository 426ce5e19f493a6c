// The cells of a batch as a structure of arrays: one lane per cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace peterka::batch {

constexpr std::size_t widest_vector = 16;  // lanes that the kernel takes at once, at most
constexpr double never = 1e9;              // as a grid point: the lane takes no part in this cycle

// Pointers into one slab of memory, each to `size` numbers. Grid point n is the forcing phase 2 pi n/steps.
struct Lanes {
    std::size_t size = 0;  // lanes in use; those that fill the last vector are idle

    // The cell: its forcing, and the harmonic responses u = Im(response exp(i theta)) in flight and contact.
    double* frequency;
    double* gap;
    double* step;  // tau from grid point to grid point
    double* flight_re;
    double* flight_im;
    double* swing;  // |flight response|
    double* contact_re;
    double* contact_im;
    double* contact_swing;

    // With a cubic spring: the linear equations' own (see flight-inl.hpp), and by how much a change of the
    // velocity raises the margin of the flag test.
    double* flight_square;
    double* flight_rate;
    double* flight_rest;
    double* contact_rate;
    double* margin_per_speed;

    // One step of free flight: (delta, delta') -> flow (delta, delta') + (push, kick), both affine in the
    // forcing's sine and cosine at the step's start.
    double* flow_cosine;
    double* flow_sine;
    double* flow_slope;
    double* flow_fall;  // of the velocity, taken from it
    double* push_sine;
    double* push_cosine;
    double* push_rest;
    double* kick_sine;
    double* kick_cosine;
    double* kick_rest;

    // The state at the current grid point and at the next; which of the two is which alternates.
    std::array<double*, 2> delta;
    std::array<double*, 2> velocity;
    double* in_use;  // 1, or 0: another engine's or nobody's
    double* next;    // grid point from which the lane is in flight again
    double* margin;  // of the flag test: what a step's cubic may be wrong by, over s^2 (1 - s)^2, over 6
    double* start_delta;
    double* start_velocity;
    double* leg_start;      // tau at which the present leg began
    double* leg_amplitude;  // of its homogeneous part, then
    double* leg_energy;     // hypot(u, u'), then

    // What the cycle did.
    double* impacts;
    double* touched;
    double* separated;
    double* peak_force;
    double* largest_displacement;
    std::array<double*, 4> jacobian;  // row by row
    std::uint64_t* pattern;
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
