// The classes of a cell, and their names. The numbers and the names are part of the file format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace peterka::cell {

enum class Regime : std::int8_t {
    no_impact = 0,
    periodic = 1,
    chaotic = 2,
    sustained_contact = 3,
    unresolved = 4,
    failed = 5,
};
inline constexpr std::int8_t regime_not_computed = -128;

// Why a cell is unresolved or failed, or what its claim leaves open; `verified` otherwise.
enum class Status : std::int8_t {
    verified = 0,
    budget = 1,           // max_cycles ran out before anything was verified
    conservative = 2,     // nothing dissipates, so nothing settles
    too_many_events = 3,  // more contacts in one forcing cycle than any physical orbit has
    not_finite = 4,       // the state overflowed the range of floating-point numbers
    solver_failed = 5,    // the integrator gave up, or the start lies inside a rigid stop
    rounding = 6,         // settled in this run, but rounding errors grew enough to end elsewhere
    imprecise = 7,        // settled, but its peak force may be off by more than solver.tolerance
    chaotic_so_far = 8,   // max_cycles ran out before chaos could be distinguished from a long transient
};

// The engine that carried the cell.
enum class Engine : std::int8_t {
    exact = 0,   // closed form; a cubic spring is left out
    split = 1,   // closed form with the cubic spring as kicks
    cvode = 2,   // Adams, or BDF where the contact is stiff
    arkode = 3,  // explicit Runge-Kutta, or implicit where the contact is stiff
};

// The compiler warns of a class without a name; nullptr for values that are no class.
constexpr const char* name(Regime regime) {
    switch (regime) {
        case Regime::no_impact:
            return "no_impact";
        case Regime::periodic:
            return "periodic";
        case Regime::chaotic:
            return "chaotic";
        case Regime::sustained_contact:
            return "sustained_contact";
        case Regime::unresolved:
            return "unresolved";
        case Regime::failed:
            return "failed";
    }
    return nullptr;
}

constexpr const char* name(Status status) {
    switch (status) {
        case Status::verified:
            return "verified";
        case Status::budget:
            return "budget";
        case Status::conservative:
            return "conservative";
        case Status::too_many_events:
            return "too_many_events";
        case Status::not_finite:
            return "not_finite";
        case Status::solver_failed:
            return "solver_failed";
        case Status::rounding:
            return "rounding";
        case Status::imprecise:
            return "imprecise";
        case Status::chaotic_so_far:
            return "chaotic_so_far";
    }
    return nullptr;
}

// What is proved about a cell in interval arithmetic, or why nothing is (certificate/certify.hpp).
enum class Certified : std::int8_t {
    force_not_bounded = -8,  // not within reasonable effort
    not_surely_stable = -7,  // a multiplier is too close to the unit circle, or beyond it
    near_grazing = -6,       // cannot be distinguished from a motion with one contact more or less
    no_orbit_enclosed = -5,  // too close to where the orbit ceases to exist
    other_label = -4,        // another p, or a smaller period
    no_orbit_found = -3,     // the cell's state leads to no periodic orbit
    other_stop = -2,         // no theorem for this law of the stop
    cubic_spring = -1,       // the cubic term is too strong for the bounds used by the proof
    not_tried = 0,
    orbit = 1,  // exists, unique in its neighbourhood, with these contacts, p and smallest q, and is stable
    start = 2,  // and [start] is proved to lead to it
};
inline constexpr int first_certified = -8;

constexpr const char* name(Engine engine) {
    switch (engine) {
        case Engine::exact:
            return "exact";
        case Engine::split:
            return "split";
        case Engine::cvode:
            return "cvode";
        case Engine::arkode:
            return "arkode";
    }
    return nullptr;
}

constexpr const char* name(Certified certified) {
    switch (certified) {
        case Certified::force_not_bounded:
            return "force_not_bounded";
        case Certified::not_surely_stable:
            return "not_surely_stable";
        case Certified::near_grazing:
            return "near_grazing";
        case Certified::no_orbit_enclosed:
            return "no_orbit_enclosed";
        case Certified::other_label:
            return "other_label";
        case Certified::no_orbit_found:
            return "no_orbit_found";
        case Certified::other_stop:
            return "other_stop";
        case Certified::cubic_spring:
            return "cubic_spring";
        case Certified::not_tried:
            return "not_tried";
        case Certified::orbit:
            return "orbit";
        case Certified::start:
            return "start";
    }
    return nullptr;
}

// The smallest value of a label; the others follow consecutively.
template <class Label>
inline constexpr int first_label = 0;
template <>
inline constexpr int first_label<Certified> = first_certified;

template <class Label>
constexpr std::size_t count_labels() {
    std::size_t count = 0;
    while (name(static_cast<Label>(first_label<Label> + static_cast<int>(count))) != nullptr) ++count;
    return count;
}

// All names of a label, in the order of its values.
template <class Label>
constexpr auto all_names() {
    std::array<const char*, count_labels<Label>()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        names[i] = name(static_cast<Label>(first_label<Label> + static_cast<int>(i)));
    }
    return names;
}

inline constexpr auto regime_names = all_names<Regime>();
inline constexpr auto status_names = all_names<Status>();
inline constexpr auto engine_names = all_names<Engine>();
inline constexpr auto certified_names = all_names<Certified>();
inline constexpr std::array<const char*, 2> chatter_names{"no_chatter", "chatter"};
inline constexpr std::array<const char*, 2> computed_names{"filled", "computed"};
inline constexpr std::array<const char*, 2> jump_names{"no_jump", "jump"};

}  // namespace peterka::cell
