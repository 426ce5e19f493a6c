// Jobs for the tests of src/job.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job::examples {

inline std::filesystem::path source_folder() {
    return PETERKA_SOURCE_DIR;
}

inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// A map whose every value differs from its default and from all others.
inline Job map() {
    Job job;
    job.kind = Kind::map;
    job.title = "A map";
    job.hammer = {.mass_kg = 0.3,
                  .natural_frequency_hz = 4.6,
                  .stiffness_n_per_m = {},
                  .damping_ns_per_m = 0.07,
                  .damping_ratio = {},
                  .cubic_stiffness_n_per_m3 = 238.5,
                  .cubic = CubicForm::absolute};
    job.cart = {.amplitude_m = 0.9e-3};
    job.contact = KelvinVoigt{.stiffness_n_per_m = 5.6e6, .damping_ns_per_m = 1.3e3};
    job.columns = {.from = 0.6, .to = 4.4, .points = 33, .scale = Spacing::log};
    job.rows = {.from = 0.1, .to = 5.1, .points = 44, .scale = Spacing::linear};
    job.start = {.displacement_ratio = -0.25, .velocity_ratio = 1.75};
    job.steady_state = {.max_cycles = 3001, .max_period = 65, .chaos_cycles = 1001};
    job.solver = {.engine = EngineChoice::split, .tolerance = 2e-9, .omit_tolerance = 2e-3};
    job.output = {.fields = {OptionalField::multiplier, OptionalField::orbit}, .anonymous = true};
    job.audit = {.cells = 150};
    job.certificate = {.cells = every_cell};
    job.noise = {.acceleration_m_s2_per_sqrt_hz = 0.05,
                 .amplitude_relative = 0.01,
                 .frequency_relative = 0.002,
                 .cycles = 20'000};
    job.refine = {.levels = 2};
    job.starts = {
        .count = 65, .displacement_ratio = {-4.5, 0.5}, .velocity_ratio = {-3.5, 3.0}, .attractors = 9};
    job.limits = {.failed_cells = 7};
    return job;
}

// The same with rigs drawn around its own: two numbers with their covariance, others each by itself.
inline Job uncertain() {
    Job job = map();
    job.title = "Uncertain rigs";
    job.uncertainty.rigs = 48;
    job.uncertainty.covariance = {.of = {"contact.stiffness_n_per_m", "operating_point.gap_m"},
                                  .mean = {5.6e6, 1e-3},
                                  .matrix = {{1e10, -0.5}, {-0.5, 1e-10}}};
    job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.03;
    job.uncertainty.numbers["hammer.mass_kg"].standard_deviation = 0.002;
    job.uncertainty.numbers["hammer.damping_ratio"] = {.from = 0.003, .to = 0.005};
    job.uncertainty.numbers["operating_point.frequency_ratio"] = {.from = -0.01, .to = 0.02};
    return job;
}

inline Job basin() {
    Job job = map();
    job.kind = Kind::basin;
    job.title = "A basin";
    job.hammer.natural_frequency_hz.reset();
    job.hammer.stiffness_n_per_m = 240.5;
    job.hammer.damping_ns_per_m.reset();
    job.hammer.damping_ratio = 0.0041;
    job.columns = {.from = 0.5, .to = 6.25, .points = 21};
    job.rows = {.from = 0.75, .to = 5.25, .points = 22};
    job.operating_point = {.frequency_ratio = 1.85, .gap_ratio = 1.65};
    job.start = {};
    job.noise = {};
    job.refine = {};
    job.starts = {};
    return job;
}

inline Job sweep() {
    Job job = map();
    job.kind = Kind::sweep;
    job.title = "A sweep";
    job.rows = {};
    job.audit = {};
    job.refine = {};
    job.starts = {};
    job.sweep = {.gap_ratio = {0.5, -1.5}, .direction = Direction::down, .samples = 48};
    return job;
}

inline Job study(StudyTopic topic) {
    Job job = topic == StudyTopic::labels ? map() : Job{};
    job.kind = Kind::study;
    job.title = "A study";
    job.hammer = basin().hammer;
    job.cart = map().cart;
    job.contact = map().contact;
    job.steady_state = map().steady_state;
    job.solver = {};
    job.output = {};
    job.audit = {};
    job.certificate = {};
    job.noise = {};
    job.refine = {};
    job.starts = {};
    job.limits = {};
    job.study.topic = topic;
    if (topic == StudyTopic::stability) job.solver.tolerance = 2e-9;
    if (topic != StudyTopic::stability) job.study.tolerances = {1e-3, 1e-5};
    if (topic == StudyTopic::work_precision) {
        job.study.frequency_ratio = {2.5, 1.0};
        job.study.gap_ratio = {0.25, -1.0};
        job.study.steps_per_cycle = {100, 300};
        job.study.cycles = 77;
        job.study.repeats = 5;
    }
    return job;
}

inline Job trace() {
    Job job = map();
    job.kind = Kind::trace;
    job.title = "A trace";
    job.columns = {};
    job.rows = {};
    job.operating_point = {.frequency_ratio = 1.85, .gap_ratio = 1.65};
    job.output = {};
    job.audit = {};
    job.certificate = {};
    job.noise = {};
    job.refine = {};
    job.starts = {};
    job.limits = {};
    job.trace.from = TraceBegin::start;
    job.trace.cycles = 7;
    job.trace.samples_per_cycle = 222;
    job.trace.impact_window_s = 0.01;
    job.trace.impact_samples = 333;
    job.trace.spectrum_to_hz = 4000;
    return job;
}

inline std::vector<Job> studies() {
    return {study(StudyTopic::work_precision), study(StudyTopic::labels), study(StudyTopic::stability)};
}

// Of each kind that has them, one with its coordinates in SI units; the last one is a trace.
inline std::vector<Job> in_si_units() {
    const OperatingPoint place{.frequency_hz = 8.5, .gap_m = 1.5e-3};
    const Start start{.displacement_m = -0.25e-3, .velocity_m_per_s = 0.05};
    Job of_map = map();
    of_map.columns.over = "frequency_hz";
    of_map.rows.over = "gap_m";
    of_map.start = start;
    of_map.starts.displacement_ratio = {};
    of_map.starts.displacement_m = {-4e-3, 0.5e-3};
    of_map.starts.velocity_ratio = {};
    of_map.starts.velocity_m_per_s = {-0.3, 0.3};
    Job of_basin = basin();
    of_basin.operating_point = place;
    of_basin.columns.over = "displacement_m";
    of_basin.rows.over = "velocity_m_per_s";
    Job of_sweep = sweep();
    of_sweep.columns.over = "frequency_hz";
    of_sweep.start = start;
    of_sweep.sweep.gap_ratio = {};
    of_sweep.sweep.gap_m = {0.5e-3, -1.5e-3};
    Job of_precision = study(StudyTopic::work_precision);
    of_precision.study.frequency_ratio = of_precision.study.gap_ratio = {};
    of_precision.study.frequency_hz = {11.5, 4.5};
    of_precision.study.gap_m = {0.25e-3, -1e-3};
    Job of_labels = study(StudyTopic::labels);
    of_labels.columns.over = "frequency_hz";
    of_labels.rows.over = "gap_m";
    Job of_trace = trace();
    of_trace.operating_point = place;
    of_trace.start = start;
    return {of_map, of_basin, of_sweep, of_precision, of_labels, of_trace};
}

}  // namespace peterka::job::examples
