// The motion at evenly spaced times, phase 0 of the forcing among them, from the beginning of the trace to its
// end.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/quantities.hpp"

namespace peterka::trace {

class Sampler : public Watcher {
  public:
    Sampler(const scene::Oscillator<double>& oscillator, double length, std::int64_t samples_per_cycle);

    // An instant of contact shows the force after its jump.
    [[nodiscard]] const std::vector<Instant>& instants() const { return instants_; }
    void finish(const State<double>& end, Phase phase) override;

  private:
    void look(const Stretch& stretch) override;
    [[nodiscard]] double next_in_cycle() const;  // tau since the cycle of the next sample began

    double period_;
    double frequency_;
    std::int64_t per_cycle_;
    std::size_t count_;  // in all
    std::vector<Instant> instants_;
};

}  // namespace peterka::trace
