#include "batch/batched_cycle_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>

#include "batch/cycle_kernel.hpp"
#include "motion/linear_motion.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::batch {

namespace {

// The range of small_sine_cosine, and of the six steps that a stretch of flight may take.
constexpr double longest_step = std::numbers::pi / 4 + 1e-9;

constexpr std::align_val_t cache_line{64};

double* allocate(std::size_t numbers) {
    return static_cast<double*>(::operator new[](numbers * sizeof(double), cache_line));
}
void deallocate(double* slab) {
    ::operator delete[](slab, cache_line);
}

constexpr std::size_t rounded_up(std::size_t slots) {
    return (slots + widest_vector - 1) / widest_vector * widest_vector;
}
// From array to array: an odd number of cache lines, or all arrays would compete for the same few of the first
// cache.
constexpr std::size_t stride(std::size_t slots) {
    constexpr std::size_t line = 8;
    return (rounded_up(slots) / line | 1U) * line;
}

std::vector<double**> fields(Lanes& l) {
    return {&l.frequency,
            &l.gap,
            &l.step,
            &l.flight_re,
            &l.flight_im,
            &l.swing,
            &l.contact_re,
            &l.contact_im,
            &l.contact_swing,
            &l.flow_cosine,
            &l.flow_sine,
            &l.flow_slope,
            &l.push_sine,
            &l.push_cosine,
            &l.push_rest,
            &l.kick_sine,
            &l.kick_cosine,
            &l.kick_rest,
            &l.delta[0],
            &l.delta[1],
            &l.velocity[0],
            &l.velocity[1],
            &l.in_use,
            &l.next,
            &l.margin,
            &l.start_delta,
            &l.start_velocity,
            &l.leg_start,
            &l.leg_amplitude,
            &l.leg_energy,
            &l.impacts,
            &l.touched,
            &l.separated,
            &l.peak_force,
            &l.largest_displacement,
            &l.jacobian[0],
            &l.jacobian[1],
            &l.jacobian[2],
            &l.jacobian[3]};
}

}  // namespace

Grid::Grid(int steps_per_cycle) : steps(steps_per_cycle) {
    for (int n = 0; n <= steps; ++n) {
        const long double angle = 2 * std::numbers::pi_v<long double> * n / steps;
        sine.push_back(static_cast<double>(std::sin(angle)));
        cosine.push_back(static_cast<double>(std::cos(angle)));
    }
}

int BatchedCycleMap::steps_for(double frequency) {
    const auto longest = [&](int steps) { return 2 * std::numbers::pi / (frequency * steps); };
    int steps = 10;
    if (longest(steps) > longest_step) steps = 16;
    while (longest(steps) > longest_step && steps < 1024) steps *= 2;
    return steps;
}

BatchedCycleMap::BatchedCycleMap(const scene::Oscillator<double>& rig, std::size_t slots, int steps_per_cycle)
    : oscillator_(rig),
      rig_(rig),
      grid_(steps_per_cycle),
      slots_(slots),
      slab_(nullptr, deallocate),
      queues_(rounded_up(slots)),
      pattern_(rounded_up(slots)),
      outcome_(rounded_up(slots)),
      twin_only_(slots),
      twins_(slots),
      is_occupied_(slots) {
    lanes_.size = rounded_up(slots);
    const auto all = fields(lanes_);
    const std::size_t numbers = stride(slots) * all.size();
    slab_.reset(allocate(numbers));
    std::fill_n(slab_.get(), numbers, 0.0);
    for (std::size_t n = 0; n < all.size(); ++n) *all[n] = slab_.get() + n * stride(slots);
    lanes_.pattern = pattern_.data();
}

scene::Oscillator<double> BatchedCycleMap::scene_of(std::size_t slot) const {
    scene::Oscillator<double> scene = oscillator_;
    scene.frequency = lanes_.frequency[slot];
    scene.gap = lanes_.gap[slot];
    return scene;
}

void BatchedCycleMap::set_state(std::size_t slot, const scene::State<double>& state) {
    lanes_.delta[0][slot] = state[0];
    lanes_.velocity[0][slot] = state[1];
}

void BatchedCycleMap::clear(std::size_t slot) {
    lanes_.in_use[slot] = 0;
    if (is_occupied_[slot]) --occupied_;
    if (twin_only_[slot]) --twin_only_count_;
    is_occupied_[slot] = false;
    twin_only_[slot] = false;
    twins_[slot].reset();
}

void BatchedCycleMap::place(std::size_t slot, double frequency, double gap, const scene::State<double>& state) {
    clear(slot);
    lanes_.frequency[slot] = frequency;
    lanes_.gap[slot] = gap;
    set_state(slot, state);
    is_occupied_[slot] = true;
    ++occupied_;

    const scene::Oscillator<double> scene = scene_of(slot);
    const motion::LinearMotion<double> flight(motion::flight_equation(scene));
    const motion::LinearMotion<double> contact(motion::contact_equation(scene));
    const double step = scene.period() / grid_.steps;
    const bool fit = rig_.fit && !flight.resonant() && !contact.resonant() && step <= longest_step;
    if (!fit) {
        twin_only_[slot] = true;
        ++twin_only_count_;
        return;
    }
    const double re = flight.response().real();
    const double im = flight.response().imag();
    lanes_.in_use[slot] = 1;
    lanes_.step[slot] = step;
    lanes_.flight_re[slot] = re;
    lanes_.flight_im[slot] = im;
    lanes_.swing[slot] = std::abs(flight.response());
    lanes_.contact_re[slot] = contact.response().real();
    lanes_.contact_im[slot] = contact.response().imag();
    lanes_.contact_swing[slot] = std::abs(contact.response());

    // x -> E x + (s' - E s), with s the steady motion at the step's start, (re, im) and eta (-im, re) on its
    // sine and cosine, and s' the same turned by one step
    const auto flow = flight.flow(step);
    const double c = grid_.cosine[1];
    const double s = grid_.sine[1];
    lanes_.flow_cosine[slot] = flow(0, 0);
    lanes_.flow_sine[slot] = flow(0, 1);
    lanes_.flow_slope[slot] = flow(1, 1);
    lanes_.push_sine[slot] = (re * c - im * s) - (flow(0, 0) * re - flow(0, 1) * frequency * im);
    lanes_.push_cosine[slot] = (re * s + im * c) - (flow(0, 0) * im + flow(0, 1) * frequency * re);
    lanes_.push_rest[slot] = -gap + flow(0, 0) * gap;
    lanes_.kick_sine[slot] = -frequency * (re * s + im * c) - (flow(1, 0) * re - flow(1, 1) * frequency * im);
    lanes_.kick_cosine[slot] = frequency * (re * c - im * s) - (flow(1, 0) * im + flow(1, 1) * frequency * re);
    lanes_.kick_rest[slot] = flow(1, 0) * gap;
}

void BatchedCycleMap::run_twin(std::size_t slot, Wanted wanted) {
    ++left_to_twin_;
    if (!twins_[slot]) twins_[slot] = std::make_unique<trajectory::ExactCycleMap<double>>(scene_of(slot));
    trajectory::Recorder<double> recorder;
    const auto cycle = (*twins_[slot])({lanes_.start_delta[slot], lanes_.start_velocity[slot]},
                                       wanted.measure ? &recorder : nullptr);
    outcome_[slot] = cycle.outcome;
    set_state(slot, cycle.end);
    lanes_.impacts[slot] = cycle.impacts;
    lanes_.touched[slot] = cycle.touched ? 1 : 0;
    lanes_.separated[slot] = cycle.separated ? 1 : 0;
    lanes_.peak_force[slot] = recorder.totals().largest_force;
    lanes_.largest_displacement[slot] = recorder.totals().displacement_bound;
    for (std::size_t n = 0; n < 4; ++n) {
        lanes_.jacobian[n][slot] = cycle.jacobian(static_cast<int>(n / 2), static_cast<int>(n % 2));
    }
    pattern_[slot] = cycle.pattern;
}

void BatchedCycleMap::advance(Wanted wanted) {
    using Outcome = trajectory::Cycle<double>::Outcome;
    run_cycle(rig_, grid_, lanes_, queues_, wanted);
    if (grid_.steps % 2 == 1) {
        std::copy_n(lanes_.delta[1], lanes_.size, lanes_.delta[0]);
        std::copy_n(lanes_.velocity[1], lanes_.size, lanes_.velocity[0]);
    }
    last_ = wanted;
    cycles_ += static_cast<std::int64_t>(occupied_);
    std::fill(outcome_.begin(), outcome_.end(), Outcome::done);
    for (std::size_t n = 0; n < queues_.twin.size; ++n) {
        run_twin(static_cast<std::size_t>(queues_.twin.lane[n]), wanted);
    }
    if (twin_only_count_ == 0) return;
    for (std::size_t slot = 0; slot < slots_; ++slot) {
        if (twin_only_[slot]) run_twin(slot, wanted);
    }
}

trajectory::Cycle<double> BatchedCycleMap::cycle(std::size_t slot) const {
    trajectory::Cycle<double> cycle;
    cycle.outcome = outcome_[slot];
    cycle.end = state(slot);
    cycle.pattern = pattern_[slot];
    cycle.impacts = static_cast<int>(lanes_.impacts[slot]);
    cycle.touched = lanes_.touched[slot] != 0;
    cycle.separated = lanes_.separated[slot] != 0;
    if (last_.jacobian) {
        cycle.jacobian << lanes_.jacobian[0][slot], lanes_.jacobian[1][slot], lanes_.jacobian[2][slot],
            lanes_.jacobian[3][slot];
    }
    return cycle;
}

}  // namespace peterka::batch
