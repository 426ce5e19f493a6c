#include "run/solve_tiles.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <utility>

#include "attractors/multi_start_pool.hpp"
#include "run/certify_cell.hpp"
#include "run/elasticities.hpp"
#include "run/mean_lives.hpp"
#include "support/stop_if_asked.hpp"
#include "support/stopwatch.hpp"

namespace peterka {
namespace {

class TileSolver {
  public:
    TileSolver(const scene::Scene& scene, const regime::AttractorTable& known, const TileWork& work,
               parallel::TileSource& source)
        : scene_(scene),
          known_(known),
          work_(work),
          source_(source),
          elasticities_(scene.job()),
          pool_(scene, known, [this](auto& solved) { keep(solved); }) {}

    void solve() {
        keep_solving(pool_, source_, [this] { return add_cell(); });
    }

  private:
    struct Open {
        parallel::Tile tile;
        std::vector<parallel::CellIndex> cells = {};
        std::vector<attractors::SolvedCell> results = {};
        std::size_t added = 0;
        std::size_t solved = 0;
        double seconds = 0;
    };

    // Adds the next cell of the first waiting tile, or of a new tile. False if none is available.
    bool add_cell() {
        while (waiting_.empty()) {
            if (open_.size() >= work_.most_in_hand) return false;
            const auto tile = source_.next();
            if (!tile) return false;
            Open& open = open_.emplace(tile->index, Open{*tile}).first->second;
            solve(open, work_.begin(*tile));
        }
        Open& open = *waiting_.front();
        const parallel::CellIndex& cell = open.cells[open.added];
        const std::int64_t number = open.tile.index * most_cells + static_cast<std::int64_t>(open.added);
        ++open.added;
        if (open.added == open.cells.size()) waiting_.pop_front();
        pool_.add(cell.row, cell.column, number);
        return true;
    }

    void solve(Open& open, std::vector<parallel::CellIndex> cells) {
        if (cells.empty()) {
            source_.solved(open.tile);
            open_.erase(open.tile.index);
            return;
        }
        open.cells = std::move(cells);
        open.results.resize(open.cells.size());
        open.added = 0;
        open.solved = 0;
        waiting_.push_front(&open);  // tiles in progress are completed before others
    }

    void keep(attractors::MultiStartPool::NumberedCell& cell) {
        Open& open = open_.at(cell.number / most_cells);
        const auto i = static_cast<std::size_t>(cell.number % most_cells);
        open.results[i] = std::move(cell.cell);
        open.seconds += cell.seconds;
        const auto [row, column] = open.cells[i];
        if (elasticities_.any() || scene_.job().noise.any() || wants_certificate(scene_.job(), row, column)) {
            if (!source_.carry_on()) throw Stopped();  // a step of the pool may end many cells
            const Stopwatch afterwards;  // reading the clock takes as long as solving a cell without impact
            certify(row, column, open.results[i]);
            add_mean_life(scene_, row, column, open.results[i].cell);
            for (attractors::CellAttractor& attractor : open.results[i].attractors) {
                certify_attractor(scene_.job(), row, column, attractor);
                add_mean_life(scene_, row, column, attractor);
            }
            elasticities_.add_to(row, column, open.results[i].cell);
            const double seconds = afterwards.seconds();
            open.seconds += seconds;
            pool_.spent_elsewhere(seconds);
        }
        if (++open.solved < open.cells.size()) return;
        solve(open, work_.go_on(open.tile, open.results, open.seconds));
    }

    void certify(std::int64_t row, std::int64_t column, attractors::SolvedCell& solved) const {
        const auto settled = certify_cell(scene_.job(), row, column, solved.cell);
        if (!settled) return;
        attractors::SolvedCell there =
            solve_from(row, column, start_of_search(scene_.cell(row, column), *settled));
        if (replaces(scene_.job(), row, column, *settled, solved.cell, there.cell)) solved = std::move(there);
    }
    [[nodiscard]] attractors::SolvedCell solve_from(std::int64_t row, std::int64_t column,
                                                    const scene::State<double>& start) const {
        attractors::SolvedCell solved;
        attractors::MultiStartPool pool(scene_, known_,
                                        [&](auto& numbered) { solved = std::move(numbered.cell); });
        pool.add(row, column, start, 0);
        while (!pool.empty()) pool.step();
        return solved;
    }

    static constexpr std::int64_t most_cells = 1 << 24;  // of a tile at a time

    const scene::Scene& scene_;
    const regime::AttractorTable& known_;
    const TileWork& work_;
    parallel::TileSource& source_;
    RequestedElasticities elasticities_;
    std::unordered_map<std::int64_t, Open> open_;  // by tile
    std::deque<Open*> waiting_;                    // with cells still to be added
    attractors::MultiStartPool pool_;
};

}  // namespace

void solve_tiles(const scene::Scene& scene, const regime::AttractorTable& known, const TileWork& work,
                 parallel::TileSource& source) {
    TileSolver(scene, known, work, source).solve();
}

}  // namespace peterka
