#include "curves/label_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "curves/beside.hpp"
#include "curves/free_motion.hpp"
#include "curves/known_curves.hpp"

namespace peterka::curves {

namespace {

using Label = std::pair<std::int64_t, std::int64_t>;  // p, q; 0, 1 without impacts

// The cells around a place, and the size of a cell there.
struct Cells {
    std::int64_t first_column = 0;
    std::int64_t first_row = 0;
    std::int64_t columns = 0;
    std::int64_t rows = 0;
    PlanePoint size;
};

class EdgeTeller {
  public:
    EdgeTeller(const Rig& rig, const CoarseMap& map, Curve& curve) : rig_(rig), map_(map), curve_(curve) {
        const PlanePoint low = map.place(0);
        const PlanePoint high = map.place(map.count() - 1);
        window_ = {high.column - low.column, high.row - low.row};
    }

    void run() {
        for (std::size_t i = 0; i < curve_.points.size(); ++i) curve_.points[i].edge = by_labels(i);
        find_reasons();
        curve_.edge = LabelEdge::unknown;
        for (const CurvePoint& point : curve_.points) {
            if (point.edge != LabelEdge::edge) curve_.edge = std::min(curve_.edge, point.edge);
        }
        if (is_edge_of_a_motion()) curve_.edge = LabelEdge::edge;
    }

  private:
    // The labels of the motions that end or change at a point of the curve.
    [[nodiscard]] std::vector<Label> labels_at(std::size_t i) const {
        const std::int64_t p = curve_.points[i].orbit.impacts();
        const std::int64_t q = curve_.period;
        if (curve_.kind == CurveKind::fold) return {{p, q}};
        if (curve_.kind == CurveKind::period_doubling) return {{p, q}, {2 * p, 2 * q}};
        return {{p, q}, {p + 1, q}};
    }

    [[nodiscard]] bool has_one_of(const std::vector<Label>& labels, std::int64_t cell) const {
        const Site& site = map_.site(cell);
        if (site.regime == regime::Regime::no_impact) return std::ranges::count(labels, Label{0, 1}) > 0;
        return site.regime == regime::Regime::periodic &&
               std::ranges::count(labels, Label{site.impacts, site.period}) > 0;
    }

    [[nodiscard]] Cells cells_around(const PlanePoint& place) const {
        std::int64_t column = 0;
        std::int64_t row = 0;
        const auto gap_of = [&](std::int64_t r) { return map_.place(r * map_.columns()).row; };
        while (column + 2 < map_.columns() && map_.place(column + 1).column <= place.column) ++column;
        while (row + 2 < map_.rows() && gap_of(row + 1) <= place.row) ++row;
        Cells cells;
        cells.size = {map_.place(column + 1).column - map_.place(column).column, gap_of(row + 1) - gap_of(row)};
        cells.first_column = std::max<std::int64_t>(column - 1, 0);
        cells.first_row = std::max<std::int64_t>(row - 1, 0);
        cells.columns = std::min(column + 3, map_.columns()) - cells.first_column;
        cells.rows = std::min(row + 3, map_.rows()) - cells.first_row;
        return cells;
    }

    // Edges within a cell of the curve's i-th point, from a cell that has one of labels_at(i).
    [[nodiscard]] std::vector<Edge> edges_at(std::size_t i) const {
        const PlanePoint& place = curve_.points[i].place;
        const std::vector<Label> labels = labels_at(i);
        const Cells cells = cells_around(place);
        std::vector<Edge> edges;
        const auto add = [&](std::int64_t a, std::int64_t b) {
            const PlanePoint one = map_.place(a);
            const PlanePoint other = map_.place(b);
            const double across = ((one.column + other.column) / 2 - place.column) / cells.size.column;
            const double up = ((one.row + other.row) / 2 - place.row) / cells.size.row;
            if (same_label(map_.site(a), map_.site(b)) || std::hypot(across, up) > 1) return;
            if (has_one_of(labels, a)) edges.push_back({a, b});
            if (has_one_of(labels, b)) edges.push_back({b, a});
        };
        for (std::int64_t row = 0; row < cells.rows; ++row) {
            for (std::int64_t column = 0; column < cells.columns; ++column) {
                const std::int64_t cell =
                    (cells.first_row + row) * map_.columns() + cells.first_column + column;
                if (column + 1 < cells.columns) add(cell, cell + 1);
                if (row + 1 < cells.rows) add(cell, cell + map_.columns());
            }
        }
        return edges;
    }

    [[nodiscard]] LabelEdge by_labels(std::size_t i) const {
        if (!edges_at(i).empty()) return LabelEdge::edge;
        const Cells cells = cells_around(curve_.points[i].place);
        const std::vector<Label> labels = labels_at(i);
        for (std::int64_t row = 0; row < cells.rows; ++row) {
            for (std::int64_t column = 0; column < cells.columns; ++column) {
                if (has_one_of(labels, (cells.first_row + row) * map_.columns() + cells.first_column + column))
                    return LabelEdge::same_label;
            }
        }
        return LabelEdge::unknown;
    }

    // One in a few undecided points is examined; those that follow take its result.
    void find_reasons() {
        constexpr std::size_t between_looks = 4;
        LabelEdge last = LabelEdge::unknown;
        std::size_t since = between_looks;
        for (std::size_t i = 0; i < curve_.points.size(); ++i) {
            LabelEdge& edge = curve_.points[i].edge;
            if (edge != LabelEdge::unknown) {
                since = between_looks;
                continue;
            }
            if (since >= between_looks) {
                last = how_far_a_motion_lives(i);
                since = 0;
            }
            ++since;
            edge = last;
        }
    }

    // A cell's width perpendicular to the curve, measured in cells.
    [[nodiscard]] PlanePoint aside(std::size_t i) const {
        const PlanePoint size = cells_around(curve_.points[i].place).size;
        const PlanePoint& before = curve_.points[i > 0 ? i - 1 : i].place;
        const PlanePoint& after = curve_.points[std::min(i + 1, curve_.points.size() - 1)].place;
        const double across = (after.column - before.column) / size.column;
        const double up = (after.row - before.row) / size.row;
        const double length = std::hypot(across, up);
        if (!(length > 0)) return {0, size.row};
        return {-up / length * size.column, across / length * size.row};
    }

    [[nodiscard]] LabelEdge how_far_a_motion_lives(std::size_t i) const {
        const OrbitPoint at{curve_.points[i].orbit, curve_.points[i].place};
        const PlanePoint way = aside(i);
        const Beside beside = motions_beside(rig_, window_, {curve_.kind, at}, way);
        for (const OrbitPoint& stable : beside.stable) {
            const double moved =
                (stable.place.column - at.place.column) / window_.column * (way.column / window_.column) +
                (stable.place.row - at.place.row) / window_.row * (way.row / window_.row);
            const double sign = moved < 0 ? -1 : 1;
            const PlanePoint target{at.place.column + sign * way.column, at.place.row + sign * way.row};
            const bool lives = stable.orbit.events.empty() ||  // without impacts
                               follow(rig_, stable, target, window_).reached;
            if (lives) return LabelEdge::other_start;
        }
        return beside.any ? LabelEdge::narrow : LabelEdge::unknown;
    }

    // Whether a cell's motion, followed across an edge, ends on the curve: labels alone may change here by
    // chance.
    [[nodiscard]] bool is_edge_of_a_motion() const {
        int left = 64;
        for (std::size_t i = 0; i < curve_.points.size(); ++i) {
            if (curve_.points[i].edge != LabelEdge::edge) continue;
            for (const Edge& edge : edges_at(i)) {
                if (--left < 0) return false;
                if (ends_on_curve(edge)) return true;
            }
        }
        return false;
    }

    [[nodiscard]] bool ends_on_curve(const Edge& edge) const {
        const PlanePoint to = map_.place(edge.to);
        if (map_.site(edge.from).regime == regime::Regime::no_impact) return room_of_free_motion(rig_, to) < 0;
        const auto orbit = map_.orbit(edge.from, window_);
        if (!orbit) return false;
        const auto seed = follow(rig_, *orbit, to, window_).seed;
        return seed && lies_on(curve_, seed->kind, seed->point.orbit.period,
                               curve_point(rig_, seed->point, seed->kind), window_);
    }

    const Rig& rig_;
    const CoarseMap& map_;
    Curve& curve_;
    PlanePoint window_;  // its size
};

}  // namespace

void tell_edges(const Rig& rig, const CoarseMap& map, Curve& curve) {
    if (!curve.points.empty()) EdgeTeller(rig, map, curve).run();
}

}  // namespace peterka::curves
