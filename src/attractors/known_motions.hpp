// The motions that a whole map knows to exist in its cells although no start found them there: impact-free
// motions, and each cell's orbits, followed from cell to cell as far as they exist.
//
// Each round continues the results of the previous round to the neighbouring cells. A cell's result depends on
// what all cells knew initially, not on who computes it: rows may be distributed if each share receives the
// results of the rows next to it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "attractors/continued_motion.hpp"
#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka::attractors {

class KnownMotions {
  public:
    // A cell's row-major number, with a motion that it knows or receives.
    struct CellMotion {
        std::int64_t cell;
        KnownMotion motion;
    };
    struct NewResult {
        std::int64_t cell;
        cell::CellResult result;
    };

    [[nodiscard]] static KnownMotion motion_of(const cell::CellResult& result);

    // Covers the rows from `first` up to `end`. `look` is called from time to time and may throw. The scene
    // must outlive this.
    KnownMotions(const scene::Scene& scene, std::int64_t first, std::int64_t end, std::function<void()> look);

    // The motions known in a cell of these rows; a cell that is never added receives nothing.
    void add(std::int64_t cell, std::vector<KnownMotion> known);
    // The impact-free motions.
    [[nodiscard]] std::vector<NewResult> free_motions();
    // The motions continued from other cells, in the order of cells; `news` must have that order.
    [[nodiscard]] std::vector<NewResult> spread(std::span<const CellMotion> news);

  private:
    struct Cell {
        bool is_there = false;
        std::vector<KnownMotion> known = {};
    };
    struct Attempt {
        std::int64_t cell;
        KnownMotion from;
    };
    [[nodiscard]] bool is_there(std::int64_t row, std::int64_t column);
    [[nodiscard]] Cell& of(std::int64_t cell);
    [[nodiscard]] scene::Cell scene_of(std::int64_t cell) const;
    [[nodiscard]] std::vector<Attempt> attempts(std::span<const CellMotion> news);
    [[nodiscard]] std::vector<NewResult> solve(const std::vector<Attempt>& attempts);
    [[nodiscard]] Task<cell::CellResult> begin(regime::CycleBroker& broker, const Attempt& attempt);

    const scene::Scene& scene_;
    job::Job job_;
    std::int64_t first_;
    std::int64_t end_;
    std::function<void()> look_;
    std::vector<Cell> cells_;
};

}  // namespace peterka::attractors
