// What the rigs drawn for a cell end in: the outcomes with their probabilities, and quantiles of the force.
//
// An outcome is a label: the regime, and for a periodic motion its p/q. Its probability is its share of the
// draws. The strength of an end is its peak force over the weight of the cell's own hammer, so that newtons are
// the same whoever reads them; on a rigid stop, its largest impact speed in m/s; without impact 0. A quantile
// is the smallest strength that this share of the draws doesn't exceed (nearest rank). A failed draw, whose
// hammer its springs throw out or which no solver follows, reaches none: it counts as 0, unless all fail.
#pragma once

#include <vector>

#include "attractors/solved_cell.hpp"
#include "scene/scene.hpp"

namespace peterka::attractors {

class Outcomes {
  public:
    // own: the cell without uncertainty; its stop tells which strength is meant.
    explicit Outcomes(const scene::Cell& own);

    // scales: those of the drawn rig.
    void add(const cell::CellResult& end, const scene::Scales& scales);
    // Tells them to the cell.
    void tell(SolvedCell& solved) const;

  private:
    [[nodiscard]] double strength_of(const cell::CellResult& end, const scene::Scales& scales) const;

    bool is_rigid_;
    double weight_n_;
    std::vector<CellOutcome> outcomes_;  // with the number of draws in place of the probability
    std::vector<double> strengths_;
    double draws_ = 0;
};

}  // namespace peterka::attractors
