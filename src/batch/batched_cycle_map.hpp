// The stroboscopic map of many cells at once: the fast twin of trajectory/exact_cycle_map.hpp.
//
// Cells sit in slots; all share springs' damping and stop (the rig), each has its own forcing and gap. One call
// carries every occupied slot through one forcing cycle. What the kernel can't do surely (resonance, stops that
// don't oscillate, grazing, slow departures) the scalar twin does; `left_to_twin` counts it. A slot's result
// depends on its cell and state alone, not on its place or its neighbours.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "batch/lanes.hpp"
#include "batch/rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::batch {

class BatchedCycleMap {
  public:
    // rig: whose damping and stop all cells share. Steps per cycle: what steps_for says, for all cells of this
    // batch.
    BatchedCycleMap(const scene::Oscillator<double>& rig, std::size_t slots, int steps_per_cycle = 16);

    // Grid steps per cycle that cells of a frequency ratio need: a step is at most pi/4 of the hammer's own
    // phase.
    static int steps_for(double frequency);

    [[nodiscard]] std::size_t slots() const { return slots_; }

    // Puts a cell into a slot, with its state (delta, delta') at forcing phase 0; or empties it.
    void place(std::size_t slot, double frequency, double gap, const scene::State<double>& state);
    void set_state(std::size_t slot, const scene::State<double>& state);
    void clear(std::size_t slot);

    // One cycle of all occupied slots.
    void advance(Wanted wanted);

    // What it gave. A Jacobian that wasn't wanted is the identity.
    [[nodiscard]] trajectory::Cycle<double> cycle(std::size_t slot) const;
    // Where wanted: the largest force F/(k A0), and an upper bound of |u| = |delta + gap|.
    [[nodiscard]] double peak_force(std::size_t slot) const { return lanes_.peak_force[slot]; }
    [[nodiscard]] double displacement_bound(std::size_t slot) const {
        return lanes_.largest_displacement[slot];
    }
    [[nodiscard]] scene::State<double> state(std::size_t slot) const {
        return {lanes_.delta[0][slot], lanes_.velocity[0][slot]};
    }

    [[nodiscard]] std::int64_t cycles() const { return cycles_; }
    [[nodiscard]] std::int64_t left_to_twin() const { return left_to_twin_; }

  private:
    [[nodiscard]] scene::Oscillator<double> scene_of(std::size_t slot) const;
    void run_twin(std::size_t slot, Wanted wanted);

    scene::Oscillator<double> oscillator_;
    Rig rig_;
    Grid grid_;
    std::size_t slots_;
    std::unique_ptr<double[], void (*)(double*)> slab_;
    Lanes lanes_{};
    Queues queues_;
    Wanted last_;
    std::vector<std::uint64_t> pattern_;
    std::vector<trajectory::Cycle<double>::Outcome> outcome_;
    std::vector<bool> twin_only_;  // the kernel can't do the cell
    std::vector<std::unique_ptr<trajectory::ExactCycleMap<double>>> twins_;
    std::size_t twin_only_count_ = 0;
    std::size_t occupied_ = 0;
    std::vector<bool> is_occupied_;
    std::int64_t cycles_ = 0;
    std::int64_t left_to_twin_ = 0;
};

}  // namespace peterka::batch
