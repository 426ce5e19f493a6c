#include "curves/search.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "curves/asked_gaps.hpp"
#include "curves/crossing_proof.hpp"
#include "curves/free_motion.hpp"
#include "curves/known_curves.hpp"
#include "curves/label_edges.hpp"
#include "support/stopwatch.hpp"

namespace peterka::curves {

namespace {

// Of tasks that are only a part of what a stage counts.
const Done untold = [](std::int64_t) {};

class CurveSearch {
  public:
    CurveSearch(const scene::Scene& scene, const Deal& deal, const Watcher& watcher)
        : deal_(deal),
          watcher_(watcher),
          job_(scene.job()),
          rig_(scene.job()),
          map_(scene, rig_),
          most_period_(scene.job().curves.max_period),
          gaps_(asked_gaps(rig_, scene.job())),
          gap_axis_(gap_axis(scene.job())),
          wants_distances_(scene.job().curves.edge_distance) {}

    CurveSearchResult run() {
        solve_map();
        window_ = {map_.place(0), map_.place(map_.count() - 1), gaps_, gap_axis_};
        cell_ = {window_.size().column / static_cast<double>(map_.columns() - 1),
                 window_.size().row / static_cast<double>(map_.rows() - 1)};
        for (std::int64_t cell = 0; cell < map_.count(); ++cell) {
            if (map_.site(cell).is_periodic(most_period_)) ++found_.periodic_cells;
        }
        for (const bool in_columns : {true, false}) trace_all(ends_of_free_motion(in_columns));
        const std::vector<Edge> edges = edges_of(map_, most_period_);
        follow_all(edges);
        count_edges(edges);
        for (std::int64_t cell = 0; cell < map_.count(); ++cell) found_.sites.push_back(map_.site(cell));
        put_in_order();
        trace_branches();
        if (job_.certificate.cells > 0) prove_crossings();
        if (wants_distances_) measure_distances();
        return found_;
    }

  private:
    static constexpr std::size_t followed_at_once = 256;
    static constexpr std::size_t traced_at_once = 32;

    void solve_map() {
        watcher_.begins({"compute", "cells", map_.count()});
        std::int64_t left = map_.count();
        const auto advance = [&](std::int64_t parts) {
            const std::int64_t cells = std::min(left, parts * map_.most_in_part());
            left -= cells;
            watcher_.advances(cells);
        };
        const auto solve = [&](std::int64_t part) { return map_.solve(part); };
        map_.put_together(deal_(map_.parts(), solve, advance));
    }

    // Between neighbours in a column or row. Of consecutive lines with equally many ends only those of the
    // first are kept, since the same curves continue through the others.
    [[nodiscard]] std::vector<Seed> ends_of_free_motion(bool in_columns) const {
        std::vector<Seed> seeds;
        std::size_t count_before = 0;
        for (std::int64_t line = 0; line < (in_columns ? map_.columns() : map_.rows()); ++line) {
            std::vector<Seed> of_line;
            PlanePoint before;
            for (std::int64_t i = 0; i < (in_columns ? map_.rows() : map_.columns()); ++i) {
                const PlanePoint now = map_.place(cell_of(map_, {!in_columns, line}, i));
                const auto seed = i > 0 ? end_of_free_motion(rig_, before, now, window_.size()) : std::nullopt;
                if (seed && window_.holds(seed->point.place)) of_line.push_back(*seed);
                before = now;
            }
            if (of_line.size() > count_before) seeds.insert(seeds.end(), of_line.begin(), of_line.end());
            count_before = of_line.size();
        }
        return seeds;
    }

    // 1 if the orbit reached the neighbour, else 0; then the seed, if any.
    [[nodiscard]] Numbers follow_edge(const Edge& edge) const {
        Numbers numbers{0};
        const auto orbit = map_.orbit(edge.from, window_.size(), edge.site);
        if (!orbit) return numbers;
        const FollowedOrbit followed = follow(rig_, *orbit, map_.place(edge.to), window_.size());
        numbers[0] = followed.reached ? 1 : 0;
        if (followed.seed) pack(*followed.seed, numbers);
        return numbers;
    }

    void follow_all(const std::vector<Edge>& edges) {
        watcher_.begins({"follow", "edges", std::ssize(edges)});
        for (std::size_t first = 0; first < edges.size(); first += followed_at_once) {
            const auto batch =
                std::span(edges).subspan(first, std::min(followed_at_once, edges.size() - first));
            const auto results = deal_(
                std::ssize(batch),
                [&](std::int64_t task) { return follow_edge(batch[static_cast<std::size_t>(task)]); }, untold);
            std::vector<Seed> seeds;
            auto edge = batch.begin();
            for (const Numbers& numbers : results) {
                NumberReader reader(numbers);
                const bool reached = reader.number() != 0;
                if (reached && edge->site == 0) reached_.emplace_back(edge->from, edge->to);
                ++edge;
                if (!reader.done()) seeds.push_back(unpack_seed(reader));
            }
            trace_all(std::move(seeds));
            watcher_.advances(std::ssize(batch));
        }
        std::ranges::sort(reached_);
    }

    [[nodiscard]] bool is_on_known_curve(const Seed& seed) const {
        const CurvePoint point = curve_point(rig_, seed.point, seed.kind);
        return std::ranges::any_of(found_.curves, [&](const Curve& curve) {
            return lies_on(curve, seed.kind, seed.point.orbit.period, point, window_.size());
        });
    }

    // Far enough from the seeds already chosen to be probably on a different curve.
    [[nodiscard]] bool stands_apart(const Seed& seed, const std::vector<Seed>& chosen) const {
        constexpr double far = 0.15;
        return std::ranges::none_of(chosen, [&](const Seed& other) {
            const double across = (seed.point.place.column - other.point.place.column) / window_.size().column;
            const double up = (seed.point.place.row - other.point.place.row) / window_.size().row;
            return seed.kind == other.kind && seed.point.orbit.period == other.point.orbit.period &&
                   seed.point.orbit.impacts() == other.point.orbit.impacts() && std::hypot(across, up) < far;
        });
    }

    void trace_all(std::vector<Seed> seeds) {
        std::erase_if(seeds, [&](const Seed& seed) { return seed.point.orbit.period > most_period_; });
        while (true) {
            std::erase_if(seeds, [&](const Seed& seed) { return is_on_known_curve(seed); });
            if (seeds.empty()) return;
            std::vector<Seed> chosen;
            std::vector<Seed> waiting;
            for (const Seed& seed : seeds) {
                const bool now = chosen.size() < traced_at_once && stands_apart(seed, chosen);
                (now ? chosen : waiting).push_back(seed);
            }
            const auto results = deal_(
                std::ssize(chosen),
                [&](std::int64_t task) {
                    const Stopwatch stopwatch;
                    Numbers numbers(1);
                    Curve curve = trace_curve(rig_, chosen[static_cast<std::size_t>(task)], window_);
                    numbers[0] = stopwatch.seconds();
                    tell_edges(rig_, map_, curve);
                    pack(curve, numbers);
                    return numbers;
                },
                untold);
            for (const Numbers& numbers : results) {
                NumberReader reader(numbers);
                const double seconds = reader.number();
                Curve curve = unpack_curve(reader);
                if (curve.points.size() < 2) continue;
                const auto known = std::ranges::find_if(
                    found_.curves, [&](const Curve& other) { return is_same(other, curve, window_.size()); });
                if (known == found_.curves.end()) {
                    found_.curves.push_back(std::move(curve));
                    found_.seconds.push_back(seconds);
                } else if (points_on(*known, curve, window_.size()) >
                           points_on(curve, *known, window_.size())) {
                    *known = std::move(curve);  // which goes on where the other ended
                    found_.seconds[static_cast<std::size_t>(known - found_.curves.begin())] = seconds;
                }
            }
            seeds = std::move(waiting);
        }
    }

    [[nodiscard]] bool did_reach(std::int64_t from, std::int64_t to) const {
        return std::ranges::binary_search(reached_, std::pair(from, to));
    }

    [[nodiscard]] bool counts(const Site& a, const Site& b) const {
        const auto known = [&](const Site& site) {
            return site.is_periodic(most_period_) || site.regime == regime::Regime::no_impact;
        };
        return known(a) && known(b);
    }

    void count_edges(const std::vector<Edge>& edges) {
        for (const Edge& edge : edges) {
            const Site& a = map_.site(edge.from);
            const Site& b = map_.site(edge.to);
            const bool both_followed = b.is_periodic(most_period_);
            if (edge.site > 0 || !counts(a, b) || (both_followed && edge.from > edge.to)) continue;
            ++found_.edges.edges;
            if (is_within_a_cell(edge)) {
                ++found_.edges.on_curve;
            } else if (did_reach(edge.from, edge.to) || did_reach(edge.to, edge.from)) {
                ++found_.edges.basin;
            }
        }
    }

    // A curve on which this motion may end: its own, one of a motion with an impact more or less, or that of
    // the motion whose period it doubles; the grazings of no impact only where one side has none.
    [[nodiscard]] static bool may_end_on(const Curve& curve, const Site& site, const Site& other) {
        const auto is_free = [](const Site& at) { return at.regime == regime::Regime::no_impact; };
        if (is_free(site)) return curve.impacts == 0;
        if (curve.kind == CurveKind::period_doubling && 2 * curve.period == site.period)
            return 2 * curve.impacts == site.impacts;
        return curve.period == site.period && std::abs(curve.impacts - site.impacts) <= 1 &&
               (curve.impacts > 0 || is_free(other));
    }

    // Of a curve on which the motion of either side may end.
    [[nodiscard]] bool is_within_a_cell(const Edge& edge) const {
        const Site& a = map_.site(edge.from);
        const Site& b = map_.site(edge.to);
        const PlanePoint from = map_.place(edge.from);
        const PlanePoint to = map_.place(edge.to);
        const PlanePoint middle{(from.column + to.column) / 2, (from.row + to.row) / 2};
        return std::ranges::any_of(found_.curves, [&](const Curve& curve) {
            return (may_end_on(curve, a, b) || may_end_on(curve, b, a)) &&
                   nearest_on(curve, middle, cell_).distance <= 1;
        });
    }

    void trace_branches() {
        std::vector<Seed> seeds;
        for (const Curve& curve : found_.curves) {
            for (const Crossing& each : curve.crossings)
                seeds.push_back({curve.kind, {each.orbit, each.place}});
        }
        const auto results = deal_(
            std::ssize(seeds),
            [&](std::int64_t task) {
                Numbers numbers;
                for (const UnstableBranch& branch :
                     unstable_branches(rig_, seeds[static_cast<std::size_t>(task)], window_)) {
                    pack(branch, numbers);
                }
                return numbers;
            },
            untold);
        for (const Numbers& numbers : results) {
            for (NumberReader reader(numbers); !reader.done();) {
                const UnstableBranch branch = unpack_branch(reader);
                const bool is_known = std::ranges::any_of(found_.branches, [&](const UnstableBranch& known) {
                    return is_same_branch(known, branch);
                });
                if (!is_known) found_.branches.push_back(branch);
            }
        }
        std::ranges::stable_sort(found_.branches, {}, [](const UnstableBranch& branch) {
            return std::tuple(branch.gap, branch.period, branch.impacts, branch.points.front().along);
        });
    }

    void prove_crossings() {
        struct Task {
            CurveKind kind;
            Crossing* crossing;
        };
        std::vector<Task> tasks;
        for (Curve& curve : found_.curves) {
            for (Crossing& crossing : curve.crossings) tasks.push_back({curve.kind, &crossing});
        }
        watcher_.begins({"prove", "crossings", std::ssize(tasks)});
        const auto results = deal_(
            std::ssize(tasks),
            [&](std::int64_t number) {
                const Stopwatch stopwatch;
                const Task& task = tasks[static_cast<std::size_t>(number)];
                const certificate::CrossingProof proof = proof_of(job_, rig_, task.kind, *task.crossing);
                return Numbers{static_cast<double>(proof.verdict), proof.at.lo, proof.at.hi,
                               stopwatch.seconds()};
            },
            watcher_.advances);
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            NumberReader reader(results[i]);
            certificate::CrossingProof& proof = tasks[i].crossing->proof;
            proof.verdict = static_cast<certificate::Crossed>(reader.integer());
            proof.at.lo = reader.number();
            proof.at.hi = reader.number();
            found_.proof_seconds += reader.number();
        }
    }

    void measure_distances() {
        const auto line_of = [&](std::int64_t task) {
            return task < map_.rows() ? LineOfCells{true, task} : LineOfCells{false, task - map_.rows()};
        };
        watcher_.begins({"measure", "lines", map_.rows() + map_.columns()});
        const auto lines = deal_(
            map_.rows() + map_.columns(),
            [&](std::int64_t task) {
                Numbers numbers;
                for (const EdgeDistance& each : edge_distances(map_, rig_, most_period_, line_of(task))) {
                    numbers.insert(numbers.end(), {each.change, static_cast<double>(each.kind)});
                }
                return numbers;
            },
            watcher_.advances);
        const auto cells = static_cast<std::size_t>(map_.count());
        found_.along_columns.resize(cells);
        found_.along_rows.resize(cells);
        for (std::int64_t task = 0; task < std::ssize(lines); ++task) {
            const LineOfCells line = line_of(task);
            NumberReader reader(lines[static_cast<std::size_t>(task)]);
            for (std::int64_t i = 0; !reader.done(); ++i) {
                const std::int64_t cell = cell_of(map_, line, i);
                EdgeDistance& each =
                    (line.is_row ? found_.along_columns : found_.along_rows)[static_cast<std::size_t>(cell)];
                each.change = reader.number();
                each.kind = static_cast<EdgeKind>(reader.integer());
            }
        }
    }

    void put_in_order() {
        std::vector<std::size_t> order(found_.curves.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::stable_sort(order, {}, [&](std::size_t i) {
            const Curve& curve = found_.curves[i];
            return std::tuple(curve.period, curve.impacts, curve.kind);
        });
        CurveSearchResult sorted = found_;
        for (std::size_t i = 0; i < order.size(); ++i) {
            sorted.curves[i] = found_.curves[order[i]];
            sorted.seconds[i] = found_.seconds[order[i]];
        }
        found_ = std::move(sorted);
    }

    const Deal& deal_;
    const Watcher& watcher_;
    const job::Job& job_;
    Rig rig_;
    CoarseMap map_;
    std::int64_t most_period_;
    std::vector<double> gaps_;
    std::size_t gap_axis_;
    bool wants_distances_;
    Window window_;
    PlanePoint cell_;
    std::vector<std::pair<std::int64_t, std::int64_t>> reached_;
    CurveSearchResult found_;
};

}  // namespace

CurveSearchResult find_curves(const scene::Scene& scene, const Deal& deal, const Watcher& watcher) {
    return CurveSearch(scene, deal, watcher).run();
}

}  // namespace peterka::curves
