// The cells of a map that never meet the stop, as their start shows: they need no search. Most of them are
// derived from another cell.
//
// With one frequency and one start, the motion without a stop is the same for every gap. The farther away the
// stop is, the more easily the proof holds, but the harder omitting the cubic term is to justify. So a result
// that holds at one gap and at the largest one of the map holds in between, and is the same but for the origin
// of delta.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "regime/cell_result.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {

class FreeCells {
  public:
    // The scene must outlive this.
    explicit FreeCells(const scene::Scene& scene);

    // The result of solve_at_once (regime/solve_cell.hpp): derived from another cell, or computed.
    [[nodiscard]] std::optional<CellResult> told_by_another(const scene::Cell& cell) const;
    [[nodiscard]] std::optional<CellResult> find(const scene::Cell& cell);
    // Number of cells for which solve_at_once was called.
    [[nodiscard]] std::int64_t computed() const { return computed_; }

  private:
    // A cell that represents those with its frequency and start and at least its gap.
    struct RecentCell {
        double frequency = 0;  // no cell has this value
        double displacement = 0;
        double velocity = 0;
        double gap = 0;
        double steady_displacement = 0;  // u at forcing phase 0
        CellResult result = {};

        [[nodiscard]] bool tells_of(const scene::Cell& cell) const;
    };
    // |u| of the steady motion without a stop: if it reaches the stop, no start stays free.
    struct Swing {
        double frequency = 0;
        double amplitude = 0;
    };
    static constexpr std::size_t places = 256;
    [[nodiscard]] static std::size_t place_of(const scene::Cell& cell);
    [[nodiscard]] bool may_be_free(const scene::Cell& cell);
    [[nodiscard]] std::optional<CellResult> compute(const scene::Cell& cell);

    const scene::Scene& scene_;
    double farthest_;  // largest gap of any cell
    std::array<Swing, places> swings_;
    std::array<RecentCell, places> known_;  // neighbours in a map share their frequencies
    std::int64_t computed_ = 0;
};

}  // namespace peterka::regime
