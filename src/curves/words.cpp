#include "curves/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "curves/border_words.hpp"
#include "job/axis_key.hpp"
#include "support/readable.hpp"

namespace peterka::curves {

namespace {

constexpr std::array kind_words{"fold", "period doubling", "grazing"};
constexpr std::array special_words{"fold with grazing",
                                   "period doubling with grazing",
                                   "two grazings",
                                   "cusp",
                                   "grazing without acceleration",
                                   "generalized period doubling"};

std::string table_of_curves(const CurveSearchResult& found) {
    struct Row {
        std::array<int, 3> curves{};
        std::size_t points = 0;
    };
    std::map<std::pair<std::int64_t, std::int64_t>, Row> rows;
    for (const Curve& curve : found.curves) {
        Row& row = rows[{curve.period, curve.impacts}];
        ++row.curves[static_cast<std::size_t>(curve.kind)];
        row.points += curve.points.size();
    }
    std::string text = fmt::format("  {:<10}{:>8}{:>18}{:>10}{:>10}\n", "z", kind_words[0], kind_words[1],
                                   kind_words[2], "points");
    for (const auto& [label, row] : rows) {
        const auto& [period, impacts] = label;
        text += fmt::format("  {:<10}{:>8}{:>18}{:>10}{:>10}\n",
                            impacts == 0 ? "no impact" : fmt::format("{}/{}", impacts, period), row.curves[0],
                            row.curves[1], row.curves[2], row.points);
    }
    return text;
}

std::string specials_text(const CurveSearchResult& found) {
    std::array<int, special_words.size()> counts{};
    for (const Curve& curve : found.curves) {
        for (const Special& special : curve.specials) ++counts[static_cast<std::size_t>(special.kind)];
    }
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i], special_words[i]);
    }
    return text.empty() ? "" : fmt::format("Special points: {}\n", text);
}

std::string edges_text(const EdgeCount& edges) {
    if (edges.edges == 0) return "";
    return fmt::format(
        "Edges of the coarse map between these orbits, or one of them and no impact: {}\n"
        "  {:>8} within one cell of a curve\n"
        "  {:>8} where the motion of one side lives on the other, too: the start decides\n"
        "  {:>8} neither\n",
        readable_count(edges.edges), readable_share(edges.on_curve, edges.edges),
        readable_share(edges.basin, edges.edges), readable_share(edges.unexplained(), edges.edges));
}

// Length of the curves for each LabelEdge, in shares of the window.
std::array<double, label_edge_kinds> lengths_by_edge(const CurveSearchResult& found, const PlanePoint& window) {
    std::array<double, label_edge_kinds> lengths{};
    for (const Curve& curve : found.curves) {
        for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
            const CurvePoint& a = curve.points[i];
            const CurvePoint& b = curve.points[i + 1];
            const double half = std::hypot((b.place.column - a.place.column) / window.column,
                                           (b.place.row - a.place.row) / window.row) /
                                2;
            for (const LabelEdge edge : {a.edge, b.edge}) lengths[static_cast<std::size_t>(edge)] += half;
        }
    }
    return lengths;
}

std::string label_edges_text(const job::Job& job, const CurveSearchResult& found) {
    static constexpr std::array words{
        "where labels of the coarse map change within a cell",
        "where cells have the label of a motion that ends or changes, but on both sides",
        "where it lives a cell's breadth from the curve, but [start] ends elsewhere",
        "where it lives in a strip narrower than a cell", "where it could not be followed"};
    const Rig rig(job);
    const PlanePoint high = rig.place_of({job.columns.to, job.rows.to});
    const PlanePoint low = rig.place_of({job.columns.from, job.rows.from});
    const auto lengths = lengths_by_edge(found, {high.column - low.column, high.row - low.row});
    const double whole = std::accumulate(lengths.begin(), lengths.end(), 0.0);
    std::array<int, label_edge_kinds> curves{};
    for (const Curve& curve : found.curves) ++curves[static_cast<std::size_t>(curve.edge)];
    std::string text = fmt::format(
        "Motions followed across edges between labels of the coarse map end on {} of the {} curves\n",
        curves[0], found.curves.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (lengths[i] == 0 && curves[i] == 0) continue;
        text += fmt::format("  {:>6.1f} % of their length {}", 100 * lengths[i] / whole, words[i]);
        text += i > 0 && curves[i] > 0 ? fmt::format("; that is why {} {} no such edge\n", curves[i],
                                                     curves[i] == 1 ? "curve has" : "curves have")
                                       : "\n";
    }
    return text;
}

// Which curves a search from a coarse map can't find.
std::string reach_in_words(const scene::Scene& scene) {
    return fmt::format(
        "Traced from the motions of {} by {} cells: curves of motions that none of these cells shows may be "
        "missing; more points or [starts] may find them\n",
        scene.columns(), scene.rows());
}

std::string axis_in_words(std::string_view key) {
    if (job::is_frequency(key)) return "the frequency";
    return job::is_gap(key) ? "the gap" : std::string(key);
}

std::string distances_text(const job::Job& job, const CurveSearchResult& found) {
    if (found.along_columns.empty()) return "";
    const auto share = [](const std::vector<EdgeDistance>& all, auto&& is_one) {
        const auto cells = std::ranges::count_if(
            all, [](const EdgeDistance& each) { return each.kind != EdgeKind::no_orbit; });
        return readable_share(std::ranges::count_if(all, is_one), cells);
    };
    const auto is_known = [](const EdgeDistance& each) { return std::isfinite(each.change); };
    const auto is_unknown = [](const EdgeDistance& each) { return each.kind == EdgeKind::unknown; };
    const std::string columns = axis_in_words(job::column_key(job));
    const std::string rows = axis_in_words(job::row_key(job));
    return fmt::format(
        "Edge of a cell's own motion within the window, of cells with one that curves are about:\n"
        "  {:>8} along {}, {} along {}\n"
        "  {:>8} could not be followed along {}, {} along {}\n",
        share(found.along_columns, is_known), columns, share(found.along_rows, is_known), rows,
        share(found.along_columns, is_unknown), columns, share(found.along_rows, is_unknown), rows);
}

}  // namespace

std::string in_words(const scene::Scene& scene, const CurveSearchResult& found) {
    const job::Job& job = scene.job();
    const std::string title = job.title.empty() ? "(no title)" : job.title;
    if (found.curves.empty()) {
        return fmt::format(
            "\n{}\nNo curve: {} of the {} cells of the coarse map have an orbit with impacts and a period of "
            "up to {} cycles (curves.max_period), and no stable motion without impacts ends within the "
            "window\n",
            title, found.periodic_cells, readable_count(scene.rows() * scene.columns()), job.curves.max_period);
    }
    double largest = 0;
    std::size_t points = 0;
    for (const Curve& curve : found.curves) {
        points += curve.points.size();
        for (const CurvePoint& point : curve.points) largest = std::max(largest, point.residual);
    }
    return fmt::format(
        "\n{}\n{} {}, {} points, residual {:.1e} at most: of the orbit's equations over 1 + its largest "
        "velocity, and of det(M -+ I) = 0 over the size of M's factors\n{}{}{}{}{}{}{}",
        title, found.curves.size(), found.curves.size() == 1 ? "curve" : "curves",
        readable_count(static_cast<std::int64_t>(points)), largest, table_of_curves(found),
        reach_in_words(scene), specials_text(found), edges_text(found.edges), label_edges_text(job, found),
        distances_text(job, found), borders_in_words(scene, found));
}

std::string speed_in_words(const CurveSearchResult& found) {
    std::vector<double> residuals;
    for (const Curve& curve : found.curves) {
        for (const CurvePoint& point : curve.points) residuals.push_back(point.residual);
    }
    const double seconds = std::accumulate(found.seconds.begin(), found.seconds.end(), 0.0);
    if (residuals.empty() || !(seconds > 0)) return "";
    const auto middle = residuals.begin() + std::ssize(residuals) / 2;
    std::ranges::nth_element(residuals, middle);
    return fmt::format("Tracing: {} points a second and rank, median residual {:.1e}\n",
                       readable_count(std::llround(static_cast<double>(residuals.size()) / seconds)), *middle);
}

}  // namespace peterka::curves
