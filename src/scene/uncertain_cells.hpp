// What the cells of a job become with each rig that [uncertainty] draws (job/rig_draws.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "job/rig_draws.hpp"
#include "scene/scene.hpp"

namespace peterka::scene {

class UncertainCells {
  public:
    explicit UncertainCells(const job::Job& job);

    [[nodiscard]] std::size_t count() const { return draws_.count(); }
    // Whether springs, dampers or stop differ between draws.
    [[nodiscard]] bool rigs_differ() const { return draws_.vary_the_rig(); }

    // Draw n of a cell with these numbers, which are those of one of the job's cells. Where the drawn stop is
    // closer, it pushes the hammer along: it never starts deeper in the stop than it does in the cell itself.
    [[nodiscard]] Cell cell(const job::CellNumbers& own, std::size_t n) const;

  private:
    // A rig drawn around the job's own, where no axis varies it.
    struct Rig {
        job::CellNumbers numbers;
        Oscillator<double> oscillator;
        Scales scales;
    };
    [[nodiscard]] Rig rig(const job::CellNumbers& own, std::size_t n) const;

    job::RigDraws draws_;
    std::vector<Rig> rigs_;  // empty: cells have their own
};

}  // namespace peterka::scene
