// The fields of a map: one table that creating, writing, checking and sizing a file all follow.
//
// A new field is one more row of the table in fields.cpp (and its member in CellResult).
#pragma once

#include <array>
#include <type_traits>
#include <variant>
#include <vector>

#include "hdf5/variable.hpp"
#include "job/job.hpp"
#include "job/names.hpp"
#include "regime/cell_result.hpp"
#include "scene/scales.hpp"

namespace peterka::quantities {

// A cell as the file holds it: a CellResult whose peak forces are over the hammer's weight, F/(m g0), and whose
// impact_speed, impulse, contact_time, contact_power and max_displacement are in m/s, Ns, s, W and m.
using StoredCell = regime::CellResult;

inline constexpr std::array<const char*, 6> regime_names{"no_impact",         "periodic",   "chaotic",
                                                         "sustained_contact", "unresolved", "failed"};
inline constexpr std::array<const char*, 9> status_names{"proved",          "budget",     "conservative",
                                                         "too_many_events", "not_finite", "solver_failed",
                                                         "rounding",        "imprecise",  "chaotic_so_far"};
inline constexpr std::array<const char*, 2> chatter_names{"no_chatter", "chatter"};
inline constexpr std::array<const char*, 2> computed_names{"filled", "computed"};
inline constexpr std::array<const char*, 2> jump_names{"no_jump", "jump"};
inline constexpr std::array<const char*, 4> engine_names{"exact", "split", "cvode", "arkode"};

// The member of a cell that a field stores, as a double (each number type used fits one exactly).
struct Member {
    double (*load)(const StoredCell&);
    void (*store)(StoredCell&, double);
};

template <auto Pointer>
inline constexpr Member member{[](const StoredCell& cell) { return static_cast<double>(cell.*Pointer); },
                               [](StoredCell& cell, double value) {
                                   cell.*Pointer =
                                       static_cast<std::remove_reference_t<decltype(cell.*Pointer)>>(value);
                               }};

enum class InAttractorTable { no, yes };

struct Always {};
struct Refined {};
struct Swept {};
struct ManyStarts {};

struct Field {
    hdf5::Variable variable;
    // always, in a refined map, in a sweep, in a map with [starts], on request, or for this law only
    std::variant<Always, Refined, Swept, ManyStarts, job::OptionalField, job::ContactLaw> stored;
    Member member;
    InAttractorTable in_attractor_table = InAttractorTable::no;
};

// The fields that a job stores, in the order of the table. A basin always stores the orbit: it tells attractors
// apart.
[[nodiscard]] std::vector<Field> stored_fields(const job::Job& job);

// The columns of a basin's table of attractors.
[[nodiscard]] std::vector<Field> attractor_fields();

// The cell in the units of the file, every NaN the same NaN, so that equal results are equal bytes.
[[nodiscard]] StoredCell in_file_units(const regime::CellResult& cell, const scene::Scales& scales);

}  // namespace peterka::quantities
