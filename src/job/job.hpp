// The job file as plain structs, in SI units and ratios as the file gives them.
//
// Each struct is one table of the file and each member one key; a default here is the default of the key. The
// names, units and meanings are those of the job file; nothing is scaled or derived in place (see
// scene/scales.hpp).
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cell/quantities.hpp"

namespace peterka::job {

enum class Kind { map, basin, sweep, study, trace, curves };
enum class CubicForm { relative, absolute };  // k3 (x - y)^3 (eq. 14 of the paper) or k3 (x^3 - y^3) (eq. 3)
enum class StudyTopic { work_precision, labels, stability };
enum class Spacing { linear, log };
enum class Direction { up, down, independent, both };  // the first three are part of the file format
enum class TraceBegin { start, steady_state };
enum class EngineChoice { automatic, exact, split, cvode, arkode };

// The hammer on its beam springs: m x'' + c (x' - y') + k (x - y) + k3 (x - y)^3 = -F.
// Exactly one of natural_frequency_hz and stiffness_n_per_m, and one of damping_ns_per_m and damping_ratio, is
// given.
struct Hammer {
    double mass_kg = 0;
    std::optional<double> natural_frequency_hz = {};  // sqrt(k/m) / (2 pi)
    std::optional<double> stiffness_n_per_m = {};
    std::optional<double> damping_ns_per_m = {};
    std::optional<double> damping_ratio = {};  // c / (2 sqrt(k m))
    double cubic_stiffness_n_per_m3 = 0;
    CubicForm cubic = CubicForm::relative;

    [[nodiscard]] double stiffness() const;  // [N/m], whichever key gave it
    [[nodiscard]] double damping() const;    // [Ns/m], whichever key gave it
    friend bool operator==(const Hammer&, const Hammer&) = default;
};

struct Cart {
    double amplitude_m = 0;  // A0 of y = A0 sin(Omega t)
    friend bool operator==(const Cart&, const Cart&) = default;
};

// Each law of the stop is a struct: its word in the file, what it is, and its keys.
// - is_rigid: it turns the hammer round at once, by forces beyond any bound
// - is_dashpot_alone: it has no spring, and never pushes the hammer back
// - has_closed_form: between events the motion is linear, so that `exact` and `split` carry it
enum class ContactLaw { kelvin_voigt, restitution, hunt_crossley };

// Spring-dashpot stop: F = ki delta + ci delta' while it presses, 0 otherwise (law = "kelvin_voigt").
struct KelvinVoigt {
    static constexpr ContactLaw law = ContactLaw::kelvin_voigt;
    static constexpr std::string_view name = "kelvin_voigt";
    static constexpr bool is_rigid = false;
    static constexpr bool has_closed_form = true;
    double stiffness_n_per_m = 0;
    double damping_ns_per_m = 0;
    [[nodiscard]] bool is_dashpot_alone() const { return stiffness_n_per_m == 0 && damping_ns_per_m > 0; }
    friend bool operator==(const KelvinVoigt&, const KelvinVoigt&) = default;
};

// Rigid stop: an impact turns the speed v into -r v (law = "restitution").
struct Restitution {
    static constexpr ContactLaw law = ContactLaw::restitution;
    static constexpr std::string_view name = "restitution";
    static constexpr bool is_rigid = true;
    static constexpr bool has_closed_form = true;
    double coefficient = 0;  // r
    [[nodiscard]] static bool is_dashpot_alone() { return false; }
    friend bool operator==(const Restitution&, const Restitution&) = default;
};

// Nonlinear stop: F = K delta^n (1 + D delta') while it presses, 0 otherwise (law = "hunt_crossley").
struct HuntCrossley {
    static constexpr ContactLaw law = ContactLaw::hunt_crossley;
    static constexpr std::string_view name = "hunt_crossley";
    static constexpr bool is_rigid = false;
    static constexpr bool has_closed_form = false;
    double stiffness_n_per_m_pow_n = 0;  // K
    double exponent = 1.5;               // n
    double dissipation_s_per_m = 0;      // D
    [[nodiscard]] static bool is_dashpot_alone() { return false; }
    friend bool operator==(const HuntCrossley&, const HuntCrossley&) = default;
};

using Contact = std::variant<KelvinVoigt, Restitution, HuntCrossley>;

[[nodiscard]] ContactLaw law_of(const Contact& contact);
[[nodiscard]] bool is_rigid(const Contact& contact);
[[nodiscard]] bool has_closed_form(const Contact& contact);
[[nodiscard]] bool is_dashpot_alone(const Contact& contact);

// `points` values from `from` to `to`, both included, evenly spaced (or evenly in the logarithm).
struct Axis {
    double from = 0;
    double to = 0;
    std::int64_t points = 0;
    Spacing scale = Spacing::linear;
    std::string over =
        {};  // what it runs over (axis_quantity.hpp); "": what jobs of its kind usually have there
    friend bool operator==(const Axis&, const Axis&) = default;
};

// One (Omega/omega, gap/A0) pair: the place at which a basin is drawn, the cell that a trace follows, or what
// the cells of a map or sweep share. Where a value is given in SI units, the ratio is the one that follows for
// the job's own rig; a cell with a rig of its own has its own (cell_numbers.hpp).
struct OperatingPoint {
    double frequency_ratio = 0;
    double gap_ratio = 0;
    std::optional<double> frequency_hz = {};
    std::optional<double> gap_m = {};
    friend bool operator==(const OperatingPoint&, const OperatingPoint&) = default;
};

// Hammer x(0)/A0 and x'(0)/(A0 omega), absolute (not relative to the cart). As with a place, values in SI units
// go before ratios, which are those of the job's own rig then.
struct Start {
    double displacement_ratio = 0;
    double velocity_ratio = 0;
    std::optional<double> displacement_m = {};
    std::optional<double> velocity_m_per_s = {};
    friend bool operator==(const Start&, const Start&) = default;
};

// Of a map: more starts in each cell, the same in all, spread evenly over a rectangle; and what of the
// attractors that they end on is kept.
struct Starts {
    std::int64_t count = 0;                            // besides [start]; 0: none
    std::vector<double> displacement_ratio = {-4, 1};  // x(0)/A0, from and to; at most the gap
    std::vector<double> displacement_m = {};           // in its place, which is empty then
    std::vector<double> velocity_ratio = {-4, 4};      // x'(0)/(A0 omega), from and to
    std::vector<double> velocity_m_per_s = {};         // in its place
    std::int64_t attractors = 8;                       // kept for each cell, those with the largest shares
    friend bool operator==(const Starts&, const Starts&) = default;
};

struct SteadyState {
    std::int64_t max_cycles = 3000;    // budget per cell [forcing cycles]
    std::int64_t max_period = 64;      // largest q looked for [forcing cycles]
    std::int64_t chaos_cycles = 1000;  // cycles before a cell may be called chaotic
    friend bool operator==(const SteadyState&, const SteadyState&) = default;
};

struct Solver {
    EngineChoice engine = EngineChoice::automatic;
    double tolerance = 1e-9;  // relative error asked for in peak force
    double omit_tolerance =
        1e-3;  // what leaving a term out may change in peak force, relative; 0 keeps every term
    friend bool operator==(const Solver&, const Solver&) = default;
};

using cell::OptionalField;

struct Output {
    std::vector<OptionalField> fields;  // sorted, each at most once
    bool anonymous = false;             // no names of hosts and of other files in the file
    [[nodiscard]] bool has(OptionalField field) const;
    friend bool operator==(const Output&, const Output&) = default;
};

struct Audit {
    std::int64_t cells = 0;  // sample of cells that an independent engine solves again
    friend bool operator==(const Audit&, const Audit&) = default;
};

inline constexpr std::int64_t every_cell = std::numeric_limits<std::int64_t>::max();

// What of a map, basin or sweep is proved in interval arithmetic.
struct Certificate {
    std::int64_t cells = 0;  // tried, drawn from all; every_cell: all
    friend bool operator==(const Certificate&, const Certificate&) = default;
};

// Of a map: first every 2^levels-th cell, then, stride after stride, only cells that those around don't tell.
struct Refine {
    std::int64_t levels = 0;  // 0: every cell is computed
    friend bool operator==(const Refine&, const Refine&) = default;
};

// One line of a sweep: a gap, and the order in which the points are visited (never `both`).
struct Branch {
    std::optional<double> gap = {};  // as the sweep's list has it; none without a list
    Direction direction = Direction::up;
    friend bool operator==(const Branch&, const Branch&) = default;
};

// Of a sweep: each branch goes through all values of the axis, from state to state or from start to start.
struct Sweep {
    std::vector<double> gap_ratio;   // both empty: the gap is the axis, or that of the operating point
    std::vector<double> gap_m = {};  // in its place
    Direction direction = Direction::both;
    std::int64_t samples = 64;  // of the steady motion stored for each point, at most
    [[nodiscard]] const std::vector<double>& gaps() const { return gap_m.empty() ? gap_ratio : gap_m; }
    [[nodiscard]] std::string_view gap_key() const { return gap_m.empty() ? "gap_ratio" : "gap_m"; }
    [[nodiscard]] std::int64_t branches() const;
    [[nodiscard]] Branch branch(std::int64_t i) const;  // gap by gap, up before down
    friend bool operator==(const Sweep&, const Sweep&) = default;
};

// Where regimes end: the curves of a window.
struct Curves {
    std::int64_t max_period = 4;     // of orbits [forcing cycles]
    std::vector<double> gap_ratio;   // at which borders are told
    std::vector<double> gap_m = {};  // in its place
    bool edge_distance = false;      // of each cell of the coarse map
    [[nodiscard]] const std::vector<double>& gaps() const { return gap_m.empty() ? gap_ratio : gap_m; }
    [[nodiscard]] std::string_view gap_key() const { return gap_m.empty() ? "gap_ratio" : "gap_m"; }
    friend bool operator==(const Curves&, const Curves&) = default;
};

// What a study compares: engines and common practice, on cells, on a map, or on a battery of extreme scenes.
struct Study {
    StudyTopic topic = StudyTopic::work_precision;
    // work_precision: cells (Omega/omega, gap/A0); by default regular ones of the paper's 170 mm rig
    std::vector<double> frequency_ratio = {2.0, 1.3, 1.1, 3.5, 2.75, 0.8, 3.1, 4.2};
    std::vector<double> gap_ratio = {0.0, 1.0, 4.0, 0.3, 0.0, 0.2, 0.0, 0.5};
    std::vector<double> frequency_hz = {};  // in place of these
    std::vector<double> gap_m = {};
    // As they were given, and their keys.
    [[nodiscard]] const std::vector<double>& frequencies() const {
        return frequency_hz.empty() ? frequency_ratio : frequency_hz;
    }
    [[nodiscard]] const std::vector<double>& gaps() const { return gap_m.empty() ? gap_ratio : gap_m; }
    [[nodiscard]] std::string_view frequency_key() const {
        return frequency_hz.empty() ? "frequency_ratio" : "frequency_hz";
    }
    [[nodiscard]] std::string_view gap_key() const { return gap_m.empty() ? "gap_ratio" : "gap_m"; }
    // work_precision and labels: relative errors in peak force that are asked for
    std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
    // work_precision: of the methods with a fixed step
    std::vector<std::int64_t> steps_per_cycle = {500, 1000, 2000, 4000, 8000, 16000};
    std::int64_t cycles = 200;  // work_precision: followed and timed [forcing cycles]
    std::int64_t repeats = 3;   // work_precision: the best of so many times counts
    friend bool operator==(const Study&, const Study&) = default;
};

// The cell of a map or basin file that a trace follows, or whose rig and place a basin has.
struct CellOfMap {
    std::string map;        // the file; empty: the job's own rig
    std::int64_t row = -1;  // of the cell, from 0; -1: the cell nearest to `values`
    std::int64_t column = -1;
    std::map<std::string, double> values = {};  // by the table and key that an axis of that file runs over
    friend bool operator==(const CellOfMap&, const CellOfMap&) = default;
};

// One cell in time. A cart at rest (frequency_ratio = 0) has no cycles: time is counted in the hammer's own
// period.
struct Trace {
    TraceBegin from = TraceBegin::steady_state;
    std::int64_t cycles = 4;  // forcing cycles shown
    double duration_s = 0;    // shown instead, with a cart at rest
    std::int64_t samples_per_cycle = 1000;
    double impact_window_s = 0;  // shown closely around the hardest impact; 0: three times its contact
    std::int64_t impact_samples = 2000;
    double spectrum_to_hz = 8000;
    friend bool operator==(const Trace&, const Trace&) = default;
};

struct Limits {
    std::int64_t failed_cells = 0;  // more failed cells than this end the run with exit code 4
    friend bool operator==(const Limits&, const Limits&) = default;
};

struct Job {
    Kind kind = Kind::map;
    std::string title;
    Hammer hammer;
    Cart cart;
    Contact contact;
    Axis columns;                    // usually frequency_ratio; basin: displacement_ratio
    Axis rows;                       // usually gap_ratio; basin: velocity_ratio; a sweep has branches instead
    OperatingPoint operating_point;  // basin and trace; map and sweep: what is no axis
    Start start;                     // map, sweep and trace
    SteadyState steady_state;
    Solver solver;
    Output output;
    Audit audit;
    Certificate certificate;  // map, basin and sweep
    Refine refine;            // map only
    Starts starts;            // map only
    Sweep sweep;              // sweep only
    Study study;              // study only
    Trace trace;              // trace only
    CellOfMap cell;           // trace and basin
    Curves curves;            // curves, and the borders of a map
    Limits limits;
    int layout = cell::newest_layout;  // of the file that it is read from, or goes into
    [[nodiscard]] std::int64_t row_count() const {
        return kind == Kind::sweep ? sweep.branches() : rows.points;
    }
    [[nodiscard]] std::int64_t cells() const { return columns.points * row_count(); }
    friend bool operator==(const Job&, const Job&) = default;
};

}  // namespace peterka::job
