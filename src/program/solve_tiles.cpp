#include "program/solve_tiles.hpp"

#include <cstddef>
#include <unordered_map>
#include <utility>

#include "regime/cell_pool.hpp"

namespace peterka {
namespace {

class TilesInHand {
  public:
    TilesInHand(const scene::Scene& scene, const TileWork& work, parallel::TileSource& source)
        : work_(work), source_(source), pool_(scene, [this](const auto& solved) { keep(solved); }) {}

    void solve() {
        while (source_.carry_on()) {
            while (pool_.has_room() && add_cell()) {
            }
            if (!pool_.empty()) {
                pool_.step();
            } else if (source_.ended()) {
                return;
            } else {
                parallel::wait_for_tiles();
            }
        }
    }

  private:
    struct Open {
        parallel::Tile tile;
        std::vector<std::int64_t> cells;
        std::vector<regime::CellResult> results;
        std::size_t solved = 0;
        double seconds = 0;
    };

    // The next cell of the tile taken last, or of another tile. False: none is at hand.
    bool add_cell() {
        while (newest_ == nullptr || added_ == newest_->cells.size()) {
            if (!take_tile()) return false;
        }
        const parallel::Tile& tile = newest_->tile;
        const std::int64_t cell = newest_->cells[added_];
        const std::int64_t number = tile.index * most_cells + static_cast<std::int64_t>(added_);
        ++added_;
        pool_.add(tile.row + cell / tile.extent.columns, tile.column + cell % tile.extent.columns, number);
        return true;
    }

    bool take_tile() {
        newest_ = nullptr;
        const auto tile = source_.next();
        if (!tile) return false;
        Open open{*tile, work_.cells_to_solve(*tile), {}};
        open.results.resize(open.cells.size());
        if (open.cells.empty()) {
            close(open);
            return true;
        }
        newest_ = &open_.emplace(tile->index, std::move(open)).first->second;
        added_ = 0;
        return true;
    }

    void keep(const regime::CellPool::Solved& cell) {
        const auto found = open_.find(cell.number / most_cells);
        Open& open = found->second;
        open.results[static_cast<std::size_t>(cell.number % most_cells)] = cell.result;
        open.seconds += cell.seconds;
        if (++open.solved < open.cells.size()) return;
        if (newest_ == &open) newest_ = nullptr;
        close(open);
        open_.erase(found);
    }

    void close(const Open& open) {
        work_.store(open.tile, open.results, open.seconds);
        source_.solved(open.tile);
    }

    static constexpr std::int64_t most_cells = parallel::tile_extent.rows * parallel::tile_extent.columns;

    const TileWork& work_;
    parallel::TileSource& source_;
    std::unordered_map<std::int64_t, Open> open_;  // by tile
    Open* newest_ = nullptr;                       // whose cells are being added
    std::size_t added_ = 0;
    regime::CellPool pool_;
};

}  // namespace

void solve_tiles(const scene::Scene& scene, const TileWork& work, parallel::TileSource& source) {
    TilesInHand(scene, work, source).solve();
}

}  // namespace peterka
