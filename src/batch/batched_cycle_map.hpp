// The stroboscopic map of many cells at once: the fast twin of trajectory/exact_cycle_map.hpp.
//
// Cells sit side by side in slots 0 to size() - 1; each has its own forcing and gap. Either all share the
// springs' damping and the stop (the rig), or each has its own; the law of the stop is common to all. One call
// carries all of them through one forcing cycle or, which is faster, by about one cycle, so that each reaches
// the end of its cycle in its own time. Cases that the kernel cannot handle with certainty (resonance, stops
// that do not oscillate, grazing) are left to the scalar twin; `left_to_twin` counts them. A cell's result
// depends only on the cell and its state, not on its slot or its neighbours.
//
// With split springs the map is that of trajectory/split_cycle_map.hpp, with a kick at each grid point (Strang
// 1968). The absolute form of the cubic is left to the twin. A rigid stop has linear springs here.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "batch/lanes.hpp"
#include "batch/rig.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::batch {

enum class Springs : std::uint8_t {
    linear,  // without the cubic part
    split,   // with it, split off as kicks
};
enum class Stop : std::uint8_t { spring_dashpot, rigid };

class BatchedCycleMap {
  public:
    // rig: its damping, springs and stop are shared by all cells. Steps per cycle, for all cells of this batch:
    // those of steps_for or, with split springs, trajectory::split_steps. The capacity grows as needed.
    BatchedCycleMap(const scene::Oscillator<double>& rig, std::size_t capacity, int steps_per_cycle = 16,
                    Springs springs = Springs::linear);
    // For cells with rigs of their own.
    BatchedCycleMap(std::size_t capacity, int steps_per_cycle, Springs springs,
                    Stop stop = Stop::spring_dashpot);

    // Grid steps per cycle needed at a frequency ratio: a step is at most pi/4 of the hammer's own phase.
    static int steps_for(double frequency);

    [[nodiscard]] std::size_t capacity() const { return twins_.size(); }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] int steps_per_cycle() const { return grid_.steps; }

    // Adds a cell at slot size(), with its state (delta, delta') at forcing phase 0.
    void add(double frequency, double gap, const scene::State<double>& state);
    // The same with its rig, for cells with rigs of their own.
    void add(const scene::Oscillator<double>& oscillator, const scene::State<double>& state);
    // Removes a cell that is at the end of its cycle; the last cell takes its slot.
    void remove(std::size_t slot);
    // Requires the same.
    void set_state(std::size_t slot, const scene::State<double>& state);

    // Cells at the end of their cycle begin the next one, and all reach its end.
    void advance();
    // The same by about one cycle: some events wait for more of their kind, which fill the vectors.
    void advance_partly();
    // Whether the cell is at the end of its cycle, as a new cell is.
    [[nodiscard]] bool is_at_end(std::size_t slot) const {
        const double next = lanes_[Field::next][slot];
        return twin_only_[slot] || (next >= grid_.steps && next < never);
    }

    // The cell's cycle, at its end.
    [[nodiscard]] trajectory::Cycle<double> cycle(std::size_t slot) const;
    // The largest force F/(k A0), and an upper bound of |u| = |delta + gap|.
    [[nodiscard]] double peak_force(std::size_t slot) const { return lanes_[Field::peak_force][slot]; }
    [[nodiscard]] double displacement_bound(std::size_t slot) const {
        return lanes_[Field::largest_displacement][slot];
    }
    // All that a recorder gathers at the level `force` or, for a rigid stop, at the level
    // `impacts`, provided that no chatter extends across the ends of the cycle.
    [[nodiscard]] trajectory::Totals<double> totals(std::size_t slot) const;
    [[nodiscard]] scene::State<double> state(std::size_t slot) const {
        return {lanes_[Field::delta][slot], lanes_[Field::velocity][slot]};
    }

    [[nodiscard]] std::int64_t left_to_twin() const { return left_to_twin_; }

  private:
    using Twin =
        std::function<trajectory::Cycle<double>(const scene::State<double>&, trajectory::Recorder<double>*)>;

    // What depends on the frequency alone or, with a cubic spring, on the frequency and the gap.
    struct Forcing {
        double frequency = 0;
        double gap = 0;
        bool fit = false;
        std::array<double, cell_fields - gap_fields> values{};

        double& operator[](Field field) { return values[index_of(field) - gap_fields]; }
        double operator[](Field field) const { return values[index_of(field) - gap_fields]; }
    };
    [[nodiscard]] Forcing forcing_of(const scene::Oscillator<double>& oscillator) const;
    const Forcing& forcing(double frequency, double gap);

    [[nodiscard]] scene::Oscillator<double> oscillator_of(double frequency, double gap) const;
    void add(const Forcing& forcing, double cubic, double gap, const scene::State<double>& state);
    void make_room(std::size_t capacity);
    void copy_slot(std::size_t slot, std::size_t to);
    void use_lanes(std::size_t size);
    [[nodiscard]] Twin twin_of(std::size_t slot) const;
    void run_twin(std::size_t slot);
    void expect_sound_queues(bool whole);

    [[nodiscard]] bool is_rigid() const { return law_ == Law::rigid; }
    void advance(bool whole);
    void run_kernel(bool whole);

    Law law_;
    scene::Oscillator<double> oscillator_;  // if all share the rig: its frequency and gap are arbitrary
    std::optional<Rig> rig_;                // empty: each cell has its own
    std::size_t fields_;                    // arrays in use
    Grid grid_;
    std::size_t size_ = 0;
    std::unique_ptr<double[], void (*)(double*)> slab_;
    Lanes lanes_;
    Queues queues_;
    std::vector<std::uint64_t> pattern_;
    std::vector<std::uint64_t> chain_pattern_;
    std::vector<trajectory::Cycle<double>::Outcome> outcome_;
    std::vector<bool> twin_only_;  // the kernel cannot handle the cell
    std::vector<Twin> twins_;
    std::vector<scene::Oscillator<double>> oscillators_;  // if each has its own rig
    std::vector<Forcing> forcings_;  // of the most recent frequencies: neighbours in a map share them
    std::size_t twin_only_count_ = 0;
    std::int64_t left_to_twin_ = 0;
};

}  // namespace peterka::batch
