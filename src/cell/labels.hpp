// The classes that a cell is put into, and their names. The numbers and the names are part of the file format.
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

// Why a cell is unresolved or failed, or what its claim leaves open; `verified` for all others.
enum class Status : std::int8_t {
    verified = 0,
    budget = 1,           // max_cycles ran out before anything was verified
    conservative = 2,     // nothing dissipates, so nothing settles
    too_many_events = 3,  // more contacts in one forcing cycle than any physical orbit has
    not_finite = 4,       // the state left the range of numbers
    solver_failed = 5,    // the integrator gave up, or the start lies inside a rigid stop
    rounding = 6,         // settled in this run, but errors of rounding grew enough to end elsewhere
    imprecise = 7,        // settled, but its peak force may be off by more than solver.tolerance
    chaotic_so_far = 8,   // max_cycles ran out before chaos could be told from a long transient
};

// Which engine carried the cell.
enum class Engine : std::int8_t {
    exact = 0,   // closed form; a cubic spring is left out
    split = 1,   // closed form with the cubic spring as kicks
    cvode = 2,   // Adams, or BDF where the contact is stiff
    arkode = 3,  // explicit Runge-Kutta, or implicit where the contact is stiff
};

// The compiler complains of a class without a name; nullptr for what is no class.
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

template <class Label>
constexpr std::size_t count_labels() {
    std::size_t count = 0;
    while (name(static_cast<Label>(count)) != nullptr) ++count;
    return count;
}

// Of 0, 1, 2, ...
template <class Label>
constexpr auto all_names() {
    std::array<const char*, count_labels<Label>()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = name(static_cast<Label>(i));
    return names;
}

inline constexpr auto regime_names = all_names<Regime>();
inline constexpr auto status_names = all_names<Status>();
inline constexpr auto engine_names = all_names<Engine>();
inline constexpr std::array<const char*, 2> chatter_names{"no_chatter", "chatter"};
inline constexpr std::array<const char*, 2> computed_names{"filled", "computed"};
inline constexpr std::array<const char*, 2> jump_names{"no_jump", "jump"};

}  // namespace peterka::cell
