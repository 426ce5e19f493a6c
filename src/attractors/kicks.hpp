// The smallest sudden change of the hammer's velocity after which the settled motion ends elsewhere, for each
// periodic attractor of a cell.
//
// Kicks at forcing phase 0, at each of the q points of an orbit, up and down, are tried in sizes that grow as
// squares; the smallest that ends elsewhere is then narrowed down by bisection. A smaller one that lies between
// two sizes tried, both of which end where they began, goes unseen.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "attractors/tally.hpp"
#include "attractors/work.hpp"
#include "scene/oscillator.hpp"

namespace peterka::attractors {

class Kicks {
  public:
    using SearchFrom = std::function<Begin(const scene::State<double>& start)>;

    // largest: of the kicks tried, in A0 omega.
    Kicks(const scene::Oscillator<double>& cell, std::span<const Tally::Entry> attractors, double largest,
          SearchFrom search_from);

    // As that of CellSearch.
    [[nodiscard]] std::vector<Begin> next(std::span<const Ended> ended);

    // Of the attractor in this slot: it surely ends elsewhere, in A0 omega; NaN where none that was tried does.
    [[nodiscard]] double smallest(std::size_t slot) const;

  private:
    enum class Stage { begin, orbits, scan, bisection, done };
    // A point of an orbit and a direction, with the sizes between which the border lies.
    struct Ray {
        std::size_t slot;
        scene::State<double> point;
        double sign;
        double stays = 0;
        double leaves = 0;  // 0: no size tried does
        [[nodiscard]] double middle() const { return (stays + leaves) / 2; }
    };

    [[nodiscard]] std::vector<Begin> follow_orbits();
    [[nodiscard]] std::vector<Begin> scan();
    [[nodiscard]] std::vector<Begin> bisect();
    void take_scan(std::span<const Ended> ended);
    void take_bisection(std::span<const Ended> ended);
    [[nodiscard]] bool ends_elsewhere(const Ray& ray, const Ended& ended) const;
    [[nodiscard]] Begin kick(const Ray& ray, double size) const;
    [[nodiscard]] double size_of(std::int64_t level) const;

    scene::Oscillator<double> cell_;
    std::vector<Tally::Entry> attractors_;
    double largest_;
    SearchFrom search_from_;
    Stage stage_ = Stage::begin;
    std::vector<std::size_t> followed_;                      // slots
    std::vector<std::vector<scene::State<double>>> orbits_;  // of these
    std::vector<Ray> rays_;
    int bisections_ = 0;
};

}  // namespace peterka::attractors
