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
#include "job/uncertainty.hpp"

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

// Each contact law is a struct: its name in the file, its properties, and its keys.
// - is_rigid: it reverses the hammer's velocity instantaneously, with unbounded force
// - is_dashpot_alone: it has no spring, and never pushes the hammer back
// - has_closed_form: between events the motion is linear, so that the engines `exact` and `split` apply
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

// Rigid stop: an impact maps the velocity v to -r v, with r the coefficient of restitution (law =
// "restitution").
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
        {};  // the quantity it varies (axis_quantity.hpp); "": the usual one for jobs of this kind
    friend bool operator==(const Axis&, const Axis&) = default;
};

// One (Omega/omega, gap/A0) pair: where a basin is computed, the cell that a trace follows, or what the cells
// of a map or sweep share. If a value is given in SI units, the ratio is that of the job's own rig; a cell with
// its own rig has its own ratio (cell_numbers.hpp).
struct OperatingPoint {
    double frequency_ratio = 0;
    double gap_ratio = 0;
    std::optional<double> frequency_hz = {};
    std::optional<double> gap_m = {};
    friend bool operator==(const OperatingPoint&, const OperatingPoint&) = default;
};

// Hammer x(0)/A0 and x'(0)/(A0 omega), absolute (not relative to the cart). As for an operating point, values
// in SI units take precedence; the ratios are then those of the job's own rig.
struct Start {
    double displacement_ratio = 0;
    double velocity_ratio = 0;
    std::optional<double> displacement_m = {};
    std::optional<double> velocity_m_per_s = {};
    friend bool operator==(const Start&, const Start&) = default;
};

// In a map or sweep: more starts in each cell, the same in all, spread evenly over a rectangle; and what of the
// attractors that they end on is kept.
struct Starts {
    std::int64_t count = 0;                            // besides [start]; 0: none
    std::vector<double> displacement_ratio = {-4, 1};  // x(0)/A0, from and to; at most the gap
    std::vector<double> displacement_m = {};           // replaces it; the ratios are then empty
    std::vector<double> velocity_ratio = {-4, 4};      // x'(0)/(A0 omega), from and to
    std::vector<double> velocity_m_per_s = {};         // in its place
    std::int64_t attractors = 8;                       // number kept per cell, largest shares first
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
    double tolerance = 1e-9;  // requested relative error of the peak force
    double omit_tolerance =
        1e-3;  // allowed relative change of the peak force on omitting a term; 0 keeps every term
    friend bool operator==(const Solver&, const Solver&) = default;
};

using cell::OptionalField;

struct Output {
    std::vector<OptionalField> fields;  // sorted, each at most once
    bool anonymous = false;             // no names of hosts or of other files in the file
    [[nodiscard]] bool has(OptionalField field) const;
    friend bool operator==(const Output&, const Output&) = default;
};

struct Audit {
    std::int64_t cells = 0;  // number of sampled cells that an independent engine solves again
    friend bool operator==(const Audit&, const Audit&) = default;
};

inline constexpr std::int64_t every_cell = std::numeric_limits<std::int64_t>::max();

// How much of a map, basin, sweep or of the places where curves have given gaps is to be proved in interval
// arithmetic.
struct Certificate {
    std::int64_t cells = 0;    // number tried, sampled from all; every_cell: all
    bool starts = false;       // also that [start] leads there, through all impacts
    bool many_digits = false;  // of starts: also where doubles lose the way
    bool attractors = false;   // also each attractor of a cell that has [starts]
    friend bool operator==(const Certificate&, const Certificate&) = default;
};

// Random disturbances under which mean lives are estimated (noise/mean_life.hpp).
struct Noise {
    double acceleration_m_s2_per_sqrt_hz = 0;  // of the hammer, as a one-sided amplitude spectral density
    double amplitude_relative = 0;             // standard deviation of the cart's amplitude, cycle by cycle
    double frequency_relative = 0;             // of the excitation frequency
    std::int64_t cycles = 100'000;             // computed for each motion, roughly [forcing cycles]
    // A motion that takes longer to forget a small deviation is not followed [forcing cycles].
    [[nodiscard]] double most_to_relax() const { return static_cast<double>(cycles) / 20; }
    [[nodiscard]] bool any() const {
        return acceleration_m_s2_per_sqrt_hz > 0 || amplitude_relative > 0 || frequency_relative > 0;
    }
    friend bool operator==(const Noise&, const Noise&) = default;
};

// Refinement of a map: first every 2^levels-th cell, then, at each finer stride, only cells that their
// surroundings do not determine.
struct Refine {
    std::int64_t levels = 0;  // 0: every cell is computed
    friend bool operator==(const Refine&, const Refine&) = default;
};

// One line of a sweep: a gap, and the order in which the points are visited (never `both`).
struct Branch {
    std::optional<double> gap = {};  // as in the sweep's list; none without a list
    Direction direction = Direction::up;
    friend bool operator==(const Branch&, const Branch&) = default;
};

// A sweep: each branch visits all values of the axis, from the previous state or each from the start.
struct Sweep {
    std::vector<double> gap_ratio;   // both empty: the gap is the axis, or that of the operating point
    std::vector<double> gap_m = {};  // in its place
    Direction direction = Direction::both;
    std::int64_t samples = 64;  // of the steady motion, at most, stored for each point
    [[nodiscard]] const std::vector<double>& gaps() const { return gap_m.empty() ? gap_ratio : gap_m; }
    [[nodiscard]] std::string_view gap_key() const { return gap_m.empty() ? "gap_ratio" : "gap_m"; }
    [[nodiscard]] std::int64_t branches() const;
    [[nodiscard]] Branch branch(std::int64_t i) const;  // gap by gap, up before down
    friend bool operator==(const Sweep&, const Sweep&) = default;
};

// The curves that bound regimes in a window.
struct Curves {
    std::int64_t max_period = 4;     // of orbits [forcing cycles]
    std::vector<double> gap_ratio;   // at which borders are reported
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
    std::vector<double> frequency_hz = {};  // in place of the ratios
    std::vector<double> gap_m = {};
    // The values as given, and their keys.
    [[nodiscard]] const std::vector<double>& frequencies() const {
        return frequency_hz.empty() ? frequency_ratio : frequency_hz;
    }
    [[nodiscard]] const std::vector<double>& gaps() const { return gap_m.empty() ? gap_ratio : gap_m; }
    [[nodiscard]] std::string_view frequency_key() const {
        return frequency_hz.empty() ? "frequency_ratio" : "frequency_hz";
    }
    [[nodiscard]] std::string_view gap_key() const { return gap_m.empty() ? "gap_ratio" : "gap_m"; }
    // work_precision and labels: requested relative errors of the peak force
    std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
    // work_precision: for the fixed-step methods
    std::vector<std::int64_t> steps_per_cycle = {500, 1000, 2000, 4000, 8000, 16000};
    std::int64_t cycles = 200;  // work_precision: cycles followed and timed [forcing cycles]
    std::int64_t repeats = 3;   // work_precision: the best of this many timings counts
    friend bool operator==(const Study&, const Study&) = default;
};

// The cell of a map or basin file that a trace follows, or whose rig and operating point a basin takes.
struct CellOfMap {
    std::string map;        // the file; empty: the job's own rig
    std::int64_t row = -1;  // of the cell, from 0; -1: the cell nearest to `values`
    std::int64_t column = -1;
    std::map<std::string, double> values = {};  // by the table and key of an axis of that file
    friend bool operator==(const CellOfMap&, const CellOfMap&) = default;
};

// One cell in time. A cart at rest (frequency_ratio = 0) has no cycles: time is counted in natural periods of
// the hammer.
struct Trace {
    TraceBegin from = TraceBegin::steady_state;
    std::int64_t cycles = 4;  // forcing cycles shown
    double duration_s = 0;    // shown instead, with a cart at rest
    std::int64_t samples_per_cycle = 1000;
    double impact_window_s = 0;  // window around the hardest impact; 0: three times its contact
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
    OperatingPoint operating_point;  // basin and trace; map and sweep: what is not an axis
    Start start;                     // map, sweep and trace
    SteadyState steady_state;
    Solver solver;
    Output output;
    Audit audit;
    Certificate certificate;  // map, basin, sweep and curves
    Noise noise;              // map or sweep
    Refine refine;            // map only
    Starts starts;            // map or sweep
    Uncertainty uncertainty;  // map or sweep
    Sweep sweep;              // sweep only
    Study study;              // study only
    Trace trace;              // trace only
    CellOfMap cell;           // trace and basin
    Curves curves;            // curves, and the borders of a map
    Limits limits;
    int layout = cell::newest_layout;  // of the file that it is read from or written to
    [[nodiscard]] std::int64_t row_count() const {
        return kind == Kind::sweep ? sweep.branches() : rows.points;
    }
    [[nodiscard]] std::int64_t cells() const { return columns.points * row_count(); }
    friend bool operator==(const Job&, const Job&) = default;
};

}  // namespace peterka::job
