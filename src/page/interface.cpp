#include "page/interface.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <vector>

#include "page/live_cell.hpp"

namespace peterka::page {

namespace {

constexpr std::size_t most_points = 4096;       // of a steady motion
constexpr std::int64_t whole_search = 1 << 30;  // more cycles than any search takes
constexpr double window_share = 0.02;           // of a period, if an impact has no width of its own

std::array<double, cell_numbers> cell;
std::array<double, answer_numbers> answer;
std::optional<LiveCell> live;
Motion motion;
scene::State<double> motion_start;
std::vector<double> points;
std::vector<double> samples;
std::vector<double> impact_list;
std::array<double, 4> multipliers;

std::optional<double> given(CellNumber number) {
    return std::isnan(cell[number]) ? std::nullopt : std::optional(cell[number]);
}

job::Contact contact_of_cell() {
    const double first = cell[contact_first];
    const double second = cell[contact_second];
    switch (static_cast<int>(cell[contact_law])) {
        case 0:
            return job::KelvinVoigt{first, second};
        case 1:
            return job::Restitution{first};
        default:
            return job::HuntCrossley{first, second, cell[contact_third]};
    }
}

std::int64_t whole(CellNumber number) {
    return std::llround(cell[number]);
}

job::Job job_of_cell(bool measures_impacts) {
    job::Job job;
    job.kind = job::Kind::trace;
    job.hammer = {.mass_kg = cell[mass_kg],
                  .natural_frequency_hz = given(natural_frequency_hz),
                  .stiffness_n_per_m = given(stiffness_n_per_m),
                  .damping_ns_per_m = given(damping_ns_per_m),
                  .damping_ratio = given(damping_ratio),
                  .cubic_stiffness_n_per_m3 = cell[cubic_stiffness_n_per_m3],
                  .cubic = static_cast<job::CubicForm>(whole(cubic_form))};
    job.cart.amplitude_m = cell[amplitude_m];
    job.contact = contact_of_cell();
    job.operating_point = {cell[frequency_ratio], cell[gap_ratio]};
    job.start = {cell[displacement_ratio], cell[velocity_ratio]};
    job.steady_state = {whole(max_cycles), whole(max_period), whole(chaos_cycles)};
    job.solver = {static_cast<job::EngineChoice>(whole(engine_choice)), cell[tolerance], cell[omit_tolerance]};
    if (measures_impacts) {
        using enum job::OptionalField;
        job.output.fields = {impact_speed, impulse, contact_power, max_displacement};
    }
    return job;
}

void give_answer() {
    const regime::CellResult result = live->result();
    const scene::Scales& scales = live->scene().scales();
    using cell::Dimension;
    const scene::State<double> steady = live->steady_start();
    answer[regime_of_cell] = static_cast<double>(result.regime);
    answer[status_of_cell] = static_cast<double>(result.status);
    answer[engine_of_cell] = static_cast<double>(result.engine);
    answer[impacts] = result.impacts;
    answer[period] = result.period;
    answer[cycles] = result.cycles;
    answer[peak_force_ratio] = scales.in_unit_of_file(result.peak_force, Dimension::force_over_weight);
    answer[impact_rate] = result.impact_rate;
    answer[chatter] = result.chatter ? 1 : 0;
    answer[lyapunov] = result.lyapunov;
    answer[sensitivity] = result.sensitivity;
    answer[impact_speed] = scales.in_unit_of_file(result.impact_speed, Dimension::speed);
    answer[impulse] = scales.in_unit_of_file(result.impulse, Dimension::impulse);
    answer[contact_time] = scales.in_unit_of_file(result.contact_time, Dimension::time);
    answer[contact_power_w] = scales.in_unit_of_file(result.contact_power, Dimension::power);
    answer[max_displacement] = scales.in_unit_of_file(result.max_displacement, Dimension::length);
    answer[orbit_displacement] = steady[0] + cell[gap_ratio];
    answer[orbit_velocity] = steady[1];
    answer[length_m] = scales.length_m;
    answer[frequency_rad_per_s] = scales.frequency_rad_per_s;
    answer[force_n] = scales.force_n;
    answer[weight_n] = scales.weight_n;
}

void give_points(const std::vector<scene::State<double>>& states) {
    points.clear();
    for (const auto& state : states) {
        points.push_back(state[0] + cell[gap_ratio]);
        points.push_back(state[1]);
    }
}

void give_samples(const std::vector<trace::Instant>& instants) {
    samples.clear();
    const trace::Carrier carrier = live->carrier();
    for (const trace::Instant& instant : instants) {
        const trace::Quantities q = trace::quantities(carrier.oscillator, instant);
        samples.insert(samples.end(), {instant.time, q.cart, q.relative, q.relative_velocity, q.force});
    }
}

void give_impacts() {
    impact_list.clear();
    for (const trace::Impact& impact : motion.impacts) {
        impact_list.insert(impact_list.end(), {impact.time, impact.end, impact.speed, impact.record.peak_force,
                                               impact.record.contact_time});
    }
}

void give_multipliers(const scene::Jacobian<double>& jacobian) {
    const double half_trace = (jacobian(0, 0) + jacobian(1, 1)) / 2;
    const double determinant = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
    const std::complex<double> root = std::sqrt(std::complex(half_trace * half_trace - determinant));
    multipliers = {half_trace + root.real(), root.imag(), half_trace - root.real(), -root.imag()};
}

}  // namespace

}  // namespace peterka::page

using namespace peterka::page;

double* peterka_cell() {
    return cell.data();
}

void peterka_begin(int measures) {
    live.emplace(job_of_cell(measures > 0), measures > 0 ? most_points : 0);
}

int peterka_advance(int cycles) {
    if (!live->advance(cycles > 0 ? cycles : whole_search)) return 0;
    give_answer();
    give_points(live->steady_motion().stroboscopic.values());
    return 1;
}

const double* peterka_answer() {
    return answer.data();
}

int peterka_count_points() {
    return static_cast<int>(points.size() / 2);
}

const double* peterka_points() {
    return points.data();
}

int peterka_follow(int steady, int cycles, int samples_per_cycle) {
    motion_start = steady > 0 ? live->steady_start() : live->start();
    motion = follow(live->carrier(), motion_start, cycles, samples_per_cycle);
    give_samples(motion.instants);
    give_points(motion.points);
    give_impacts();
    give_multipliers(motion.jacobian);
    return static_cast<int>(motion.cycles);
}

int peterka_count_samples() {
    return static_cast<int>(samples.size() / 5);
}

const double* peterka_samples() {
    return samples.data();
}

int peterka_count_impacts() {
    return static_cast<int>(impact_list.size() / 5);
}

const double* peterka_impacts() {
    return impact_list.data();
}

const double* peterka_multipliers() {
    return multipliers.data();
}

void peterka_look_closely(int impact, int count) {
    const auto carrier = live->carrier();
    give_samples(look_closely(carrier, motion_start, motion, static_cast<std::size_t>(impact), count,
                              window_share * carrier.oscillator.period()));
}
