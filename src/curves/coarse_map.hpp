// The labels and orbits of a coarse map of the window, and its edges: neighbours with different labels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "curves/follow.hpp"
#include "curves/mpi_packing.hpp"
#include "regime/cell_result.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

// One motion of a cell.
struct Site {
    regime::Regime regime = regime::Regime::failed;
    regime::Status status = regime::Status::verified;
    std::int64_t impacts = 0;
    std::int64_t period = 0;
    double peak_force = regime::unknown;          // F/(k A0)
    State<double> orbit = State<double>::Zero();  // (delta, delta') at forcing phase 0, if periodic

    friend bool same_label(const Site& a, const Site& b) {
        return a.regime == b.regime && a.impacts == b.impacts && a.period == b.period;
    }
    [[nodiscard]] bool is_periodic(std::int64_t most) const {
        return regime == regime::Regime::periodic && period <= most && impacts > 0;
    }
};

class CoarseMap {
  public:
    CoarseMap(const scene::Scene& scene, const Rig& rig) : scene_(&scene), rig_(&rig) {}

    // The map is computed in parts, each by one call on any rank, and then put together.
    [[nodiscard]] std::int64_t parts() const;
    [[nodiscard]] static std::int64_t most_in_part() { return cells_in_part; }
    [[nodiscard]] Numbers solve(std::int64_t part) const;
    void put_together(const std::vector<Numbers>& parts);

    [[nodiscard]] std::int64_t rows() const { return scene_->rows(); }
    [[nodiscard]] std::int64_t columns() const { return scene_->columns(); }
    [[nodiscard]] std::int64_t count() const { return rows() * columns(); }
    [[nodiscard]] const Site& site(std::int64_t cell) const {
        return sites_[static_cast<std::size_t>(cell)].front();
    }
    // site(cell), and the periodic motions on which other starts of the cell end if the job has [starts].
    [[nodiscard]] const std::vector<Site>& sites(std::int64_t cell) const {
        return sites_[static_cast<std::size_t>(cell)];
    }
    [[nodiscard]] PlanePoint place(std::int64_t cell) const;
    // The orbit of one of a cell's sites; none if the equations have no stable solution next to it.
    [[nodiscard]] std::optional<OrbitPoint> orbit(std::int64_t cell, const PlanePoint& window,
                                                  std::size_t site = 0) const;

  private:
    static constexpr std::int64_t cells_in_part = 2048;

    const scene::Scene* scene_;
    const Rig* rig_;
    std::vector<std::vector<Site>> sites_;
};

// From the cell whose orbit is followed to its neighbour.
struct Edge {
    std::int64_t from = 0;
    std::int64_t to = 0;
    std::size_t site = 0;  // of sites(from); 0 at an edge between labels
};

// All edges of periodic cells up to a period, one for each side whose orbit can be followed, and those of
// further motions that the neighbour lacks, in an order that scatters them over the plane.
[[nodiscard]] std::vector<Edge> edges_of(const CoarseMap& map, std::int64_t most_period);

}  // namespace peterka::curves
