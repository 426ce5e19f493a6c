#include "batch/batched_cycle_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <new>
#include <numbers>
#include <utility>

#include "batch/cycle_kernel.hpp"
#include "support/expect.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::batch {

namespace {

// The columns of a tile and of its neighbours.
constexpr std::size_t frequencies_kept = 256;

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
// Distance between arrays: an odd number of cache lines, otherwise all arrays would compete for the same few
// sets of the first-level cache.
constexpr std::size_t stride(std::size_t slots) {
    constexpr std::size_t line = 8;
    return (rounded_up(slots) / line | 1U) * line;
}

Law law_of(bool rigid, Springs springs) {
    PETERKA_EXPECT(!rigid || springs == Springs::linear);
    if (rigid) return Law::rigid;
    return springs == Springs::split ? Law::kicks : Law::spring_dashpot;
}

}  // namespace

Grid::Grid(int steps_per_cycle) : steps(steps_per_cycle) {
    for (int n = 0; n <= steps; ++n) {
        const long double angle = 2 * std::numbers::pi_v<long double> * n / steps;
        sine.push_back(static_cast<double>(std::sin(angle)));
        cosine.push_back(static_cast<double>(std::cos(angle)));
    }
}

BatchedCycleMap::BatchedCycleMap(const scene::Oscillator<double>& rig, std::size_t capacity,
                                 int steps_per_cycle, Springs springs)
    : law_(law_of(scene::is_rigid(rig.contact), springs)),
      oscillator_(springs == Springs::split ? rig : without_cubic(rig)),
      rig_(oscillator_),
      fields_(is_rigid() ? fields_of_rigid_stops : fields),
      grid_(steps_per_cycle),
      slab_(nullptr, deallocate),
      forcings_(frequencies_kept) {
    make_room(capacity);
}

BatchedCycleMap::BatchedCycleMap(std::size_t capacity, int steps_per_cycle, Springs springs, Stop stop)
    : law_(law_of(stop == Stop::rigid, springs)),
      fields_(is_rigid() ? fields_of_rigid_stops : fields_with_rigs),
      grid_(steps_per_cycle),
      slab_(nullptr, deallocate) {
    make_room(capacity);
}

void BatchedCycleMap::make_room(std::size_t capacity) {
    const std::size_t distance = stride(capacity);
    std::unique_ptr<double[], void (*)(double*)> slab(allocate(distance * fields_), deallocate);
    std::fill_n(slab.get(), distance * fields_, 0.0);
    for (std::size_t n = 0; n < fields_; ++n) {
        double* array = slab.get() + n * distance;
        if (slab_) std::copy_n(lanes_.arrays[n], size_, array);
        lanes_.arrays[n] = array;
    }
    slab_ = std::move(slab);
    queues_.make_room(rounded_up(capacity));
    pattern_.resize(rounded_up(capacity));
    lanes_.pattern = pattern_.data();
    chain_pattern_.resize(rounded_up(capacity));
    lanes_.chain_pattern = chain_pattern_.data();
    outcome_.resize(rounded_up(capacity));
    twin_only_.resize(capacity);
    twins_.resize(capacity);
    if (!rig_) oscillators_.resize(capacity);
}

scene::Oscillator<double> BatchedCycleMap::oscillator_of(double frequency, double gap) const {
    scene::Oscillator<double> oscillator = oscillator_;
    oscillator.frequency = frequency;
    oscillator.gap = gap;
    return oscillator;
}

void BatchedCycleMap::set_state(std::size_t slot, const scene::State<double>& state) {
    lanes_[Field::delta][slot] = state[0];
    lanes_[Field::velocity][slot] = state[1];
}

const BatchedCycleMap::Forcing& BatchedCycleMap::forcing(double frequency, double gap) {
    Forcing& kept = forcings_[std::hash<double>()(frequency) % frequencies_kept];
    const bool fits = kept.frequency == frequency && (oscillator_.cubic == 0 || kept.gap == gap);
    if (!fits) kept = forcing_of(oscillator_of(frequency, gap));
    return kept;
}

// The kernel processes whole vectors; lanes past the last cell stay idle.
void BatchedCycleMap::use_lanes(std::size_t size) {
    for (std::size_t slot = size; slot < rounded_up(size); ++slot) lanes_[Field::next][slot] = never;
    size_ = size;
    lanes_.size = size;
}

void BatchedCycleMap::add(double frequency, double gap, const scene::State<double>& state) {
    PETERKA_EXPECT(rig_ && frequency > 0);
    add(forcing(frequency, gap), oscillator_.cubic, gap, state);
}

void BatchedCycleMap::add(const scene::Oscillator<double>& oscillator, const scene::State<double>& state) {
    PETERKA_EXPECT(!rig_ &&
                   (is_rigid() ? scene::is_rigid(oscillator.contact) : oscillator.spring_dashpot() != nullptr));
    const std::size_t slot = size_;
    const scene::Oscillator<double> own = law_ == Law::kicks ? oscillator : without_cubic(oscillator);
    add(forcing_of(own), own.cubic, own.gap, state);
    lanes_[Field::damping_ratio][slot] = own.damping_ratio;
    lanes_[Field::cubic][slot] = own.cubic;
    if (is_rigid()) {
        lanes_[Field::restitution][slot] = own.restitution().coefficient;
    } else {
        lanes_[Field::stiffness][slot] = own.kelvin_voigt().stiffness;
        lanes_[Field::damping][slot] = own.kelvin_voigt().damping;
    }
    oscillators_[slot] = own;
}

void BatchedCycleMap::add(const Forcing& f, double cubic, double gap, const scene::State<double>& state) {
    PETERKA_EXPECT(std::isfinite(gap) && std::isfinite(cubic));
    const std::size_t slot = size_;
    if (slot == capacity()) make_room(2 * slot);
    use_lanes(slot + 1);
    set_state(slot, state);
    for (std::size_t n = gap_fields; n < cell_fields; ++n) lanes_.arrays[n][slot] = f.values[n - gap_fields];
    const double below_stop = (gap + cubic * gap * gap * gap) / f[Field::flight_square];  // the static position
    lanes_[Field::gap][slot] = gap;
    lanes_[Field::static_position][slot] = -below_stop;
    lanes_[Field::forced_delta_constant][slot] = -below_stop + f[Field::e00] * below_stop;
    lanes_[Field::forced_velocity_constant][slot] = f[Field::e10] * below_stop;
    lanes_[Field::next][slot] = f.fit ? grid_.steps : never;
    if (is_rigid()) {
        const double drive = f.frequency * f.frequency;
        const trajectory::RigidStop<double> stop(0, 0, f.frequency, {.constant = -gap, .linear = drive});
        lanes_[Field::press_from][slot] =
            stop.always_presses() ? 0 : std::min(stop.ahead_to_pressing(0), never);
        lanes_[Field::press_to][slot] = std::min(stop.ahead_to_release(0), never);
    }
    twin_only_[slot] = !f.fit;
    twins_[slot] = nullptr;
    if (!f.fit) ++twin_only_count_;
}

void BatchedCycleMap::copy_slot(std::size_t slot, std::size_t to) {
    for (std::size_t n = 0; n < fields_; ++n) lanes_.arrays[n][to] = lanes_.arrays[n][slot];
    if (!rig_) oscillators_[to] = oscillators_[slot];
    twin_only_[to] = twin_only_[slot];
    pattern_[to] = pattern_[slot];
    chain_pattern_[to] = chain_pattern_[slot];
    outcome_[to] = outcome_[slot];
}

void BatchedCycleMap::remove(std::size_t slot) {
    PETERKA_EXPECT(slot < size_);
    if (twin_only_[slot]) --twin_only_count_;
    const std::size_t last = size_ - 1;
    if (slot != last) copy_slot(last, slot);
    if (slot != last && !is_at_end(last)) {
        for (Queue* queue : queues_.events())
            queue->rename(static_cast<std::int64_t>(last), static_cast<std::int64_t>(slot));
    }
    twins_[slot] = std::move(twins_[last]);
    twins_[last] = nullptr;
    use_lanes(last);
}

BatchedCycleMap::Twin BatchedCycleMap::twin_of(std::size_t slot) const {
    const auto oscillator =
        rig_ ? oscillator_of(lanes_[Field::frequency][slot], lanes_[Field::gap][slot]) : oscillators_[slot];
    if (is_rigid()) return trajectory::RigidExactMap<double>(oscillator);
    if (law_ == Law::kicks) return trajectory::SplitCycleMap<double>(oscillator, grid_.steps);
    return trajectory::ExactCycleMap<double>(oscillator);
}

void BatchedCycleMap::run_twin(std::size_t slot) {
    ++left_to_twin_;
    if (!twin_only_[slot]) lanes_[Field::next][slot] = grid_.steps;
    if (!twins_[slot]) twins_[slot] = twin_of(slot);
    trajectory::Recorder<double> recorder(is_rigid() ? trajectory::Detail::impacts : trajectory::Detail::force);
    const auto cycle =
        twins_[slot]({lanes_[Field::start_delta][slot], lanes_[Field::start_velocity][slot]}, &recorder);
    outcome_[slot] = cycle.outcome;
    set_state(slot, cycle.end);
    lanes_[Field::impacts][slot] = cycle.impacts;
    lanes_[Field::touched][slot] = cycle.touched ? 1 : 0;
    lanes_[Field::separated][slot] = cycle.separated ? 1 : 0;
    if (is_rigid()) {
        lanes_[Field::swallowed][slot] = static_cast<double>(cycle.impacts - recorder.totals().impacts);
        lanes_[Field::chatter][slot] = recorder.totals().chatter ? 1 : 0;
        lanes_[Field::impact_speed][slot] = recorder.totals().impact_speed;
        lanes_[Field::impulse][slot] = recorder.totals().impulse;
        lanes_[Field::contact_time][slot] = recorder.totals().contact_time;
        lanes_[Field::contact_work][slot] = recorder.totals().contact_work;
    }
    lanes_[Field::peak_force][slot] = recorder.totals().largest_force;
    lanes_[Field::largest_displacement][slot] = recorder.totals().displacement_bound;
    for (std::size_t n = 0; n < 4; ++n) {
        lanes_.jacobian(n)[slot] = cycle.jacobian(static_cast<int>(n / 2), static_cast<int>(n % 2));
    }
    pattern_[slot] = cycle.pattern;
}

// All queued lanes exist, each waits for one event at a time, and none waits once all have reached the end of
// their cycle.
void BatchedCycleMap::expect_sound_queues([[maybe_unused]] bool whole) {
#ifdef PETERKA_EXPECTS
    std::size_t waiting = queues_.twin.size;
    for (const Queue* queue : queues_.events()) {
        PETERKA_EXPECT(queue->size == 0 || !whole);
        waiting += queue->size;
        for (std::size_t n = 0; n < queue->size; ++n) {
            PETERKA_EXPECT(0 <= queue->lane[n] && static_cast<std::size_t>(queue->lane[n]) < size_);
        }
    }
    PETERKA_EXPECT(waiting <= size_);
#endif
}

void BatchedCycleMap::run_kernel(bool whole) {
    const bool kicks = law_ == Law::kicks && (!rig_ || rig_->cubic != 0);
    if (rig_) {
        const auto run = is_rigid() ? run_rigid_cycle : kicks ? run_split_cycle : run_linear_cycle;
        return run(*rig_, grid_, lanes_, queues_, whole);
    }
    const auto run = is_rigid() ? run_own_rigs_rigid_cycle
                     : kicks    ? run_own_rigs_split_cycle
                                : run_own_rigs_cycle;
    run(grid_, lanes_, queues_, whole);
}

void BatchedCycleMap::advance() {
    advance(true);
}

void BatchedCycleMap::advance_partly() {
    advance(false);
}

void BatchedCycleMap::advance(bool whole) {
    using Outcome = trajectory::Cycle<double>::Outcome;
    run_kernel(whole);
    expect_sound_queues(whole);
    std::fill_n(outcome_.begin(), size_, Outcome::done);
    for (std::size_t n = 0; n < queues_.twin.size; ++n) {
        run_twin(static_cast<std::size_t>(queues_.twin.lane[n]));
    }
    if (twin_only_count_ == 0) return;
    for (std::size_t slot = 0; slot < size_; ++slot) {
        if (!twin_only_[slot]) continue;
        lanes_[Field::start_delta][slot] = lanes_[Field::delta][slot];
        lanes_[Field::start_velocity][slot] = lanes_[Field::velocity][slot];
        run_twin(slot);
    }
}

trajectory::Totals<double> BatchedCycleMap::totals(std::size_t slot) const {
    PETERKA_EXPECT(slot < size_ && is_at_end(slot));
    trajectory::Totals<double> totals;
    totals.impacts = static_cast<std::int64_t>(lanes_[Field::impacts][slot]);
    totals.largest_force = peak_force(slot);
    totals.displacement_bound = displacement_bound(slot);
    if (!is_rigid()) return totals;
    totals.struck_rigid_stop = totals.impacts > 0;
    totals.impacts -= static_cast<std::int64_t>(lanes_[Field::swallowed][slot]);
    totals.chatter = lanes_[Field::chatter][slot] != 0;
    totals.impact_speed = lanes_[Field::impact_speed][slot];
    totals.impulse = lanes_[Field::impulse][slot];
    totals.contact_time = lanes_[Field::contact_time][slot];
    totals.contact_work = lanes_[Field::contact_work][slot];
    return totals;
}

trajectory::Cycle<double> BatchedCycleMap::cycle(std::size_t slot) const {
    PETERKA_EXPECT(slot < size_ && is_at_end(slot));
    trajectory::Cycle<double> cycle;
    cycle.outcome = outcome_[slot];
    cycle.end = state(slot);
    cycle.pattern = pattern_[slot];
    cycle.impacts = static_cast<int>(lanes_[Field::impacts][slot]);
    cycle.touched = lanes_[Field::touched][slot] != 0;
    cycle.separated = lanes_[Field::separated][slot] != 0;
    // column by column: what is stored in pairs can be loaded in pairs without a stall
    cycle.jacobian.col(0) = scene::State<double>(lanes_.jacobian(0)[slot], lanes_.jacobian(2)[slot]);
    cycle.jacobian.col(1) = scene::State<double>(lanes_.jacobian(1)[slot], lanes_.jacobian(3)[slot]);
    return cycle;
}

}  // namespace peterka::batch
