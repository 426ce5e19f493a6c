// The motions that a whole map knows to exist in its cells though no start found them there: those without
// impact, and each orbit of a cell, followed from cell to cell for as far as it goes.
//
// A round continues what the last one brought to the cells beside it. What a cell gets depends on what all
// cells knew in the beginning, not on who computes it: rows may be shared out, if each share is told what came
// to the rows beside it.
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
    // A cell by its number, row by row, with a motion that it knows, or gets.
    struct CellMotion {
        std::int64_t cell;
        KnownMotion motion;
    };
    struct NewResult {
        std::int64_t cell;
        cell::CellResult result;
    };

    [[nodiscard]] static KnownMotion motion_of(const cell::CellResult& result);

    // Of the rows from `first` up to `end`. `look`, called every now and then, may throw. The scene must
    // outlive this.
    KnownMotions(const scene::Scene& scene, std::int64_t first, std::int64_t end, std::function<void()> look);

    // What a cell of these rows knows; a cell that nobody adds gets nothing.
    void add(std::int64_t cell, std::vector<KnownMotion> known);
    // The motions without impact.
    [[nodiscard]] std::vector<NewResult> free_motions();
    // What is continued from others, in the order of cells; news: in that order.
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
