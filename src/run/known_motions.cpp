#include "run/known_motions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "attractors/known_motions.hpp"
#include "attractors/tally.hpp"
#include "map_file/known_slots.hpp"
#include "parallel/collective.hpp"
#include "quantities/fields.hpp"
#include "run/certify_cell.hpp"
#include "run/mean_lives.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka {
namespace {

using attractors::KnownMotion;
using attractors::KnownMotions;
using map_file::MapFile;
using map_file::Slots;
using parallel::Tile;

bool has_slots(const job::Job& job) {
    return job.kind == job::Kind::map && job.starts.count > 0;
}

// A tile with the slots of its cells, as stored in the file.
struct TileSlots {
    Tile tile;
    std::vector<quantities::StoredCell> cells;
    std::vector<Slots> slots;  // of each cell, those in use
    std::int64_t kept;

    TileSlots(const MapFile& file, std::int64_t index, std::int64_t kept_slots)
        : tile(file.tiling().tile(index)), cells(file.read_tile(index)), slots(cells.size()), kept(kept_slots) {
        const std::vector<quantities::StoredAttractor> all = file.read_attractors(index);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].regime != static_cast<regime::Regime>(regime::regime_not_computed))
                slots[i % cells.size()].push_back(all[i]);
        }
    }
    [[nodiscard]] std::vector<quantities::StoredAttractor> in_file_order() const {
        std::vector<quantities::StoredAttractor> all(static_cast<std::size_t>(kept) * cells.size());
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            for (std::size_t slot = 0; slot < slots[cell].size(); ++slot) {
                all[slot * cells.size() + cell] = slots[cell][slot];
            }
        }
        return all;
    }
};

KnownMotion motion_of(const quantities::StoredAttractor& slot) {
    return {.regime = slot.regime,
            .impacts = slot.impacts,
            .period = slot.period,
            .displacement = slot.orbit_displacement,
            .velocity = slot.orbit_velocity};
}

// This rank's rows of tiles.
class Rows {
  public:
    Rows(const scene::Scene& scene, MapFile& file, MPI_Comm communicator)
        : scene_(scene),
          file_(file),
          kept_(scene.job().starts.attractors),
          share_(parallel::share_of(file.tiling().tiles().rows, communicator)),
          first_(first_row(share_.first)),
          end_(first_row(share_.end)),
          known_(scene, first_, end_, [] { look_for_stop_request(); }) {}

    // The motions known before in these rows of tiles and the adjacent ones, in the order of cells.
    [[nodiscard]] std::vector<KnownMotions::CellMotion> read() {
        std::vector<KnownMotions::CellMotion> before;
        const std::int64_t rows = file_.tiling().tiles().rows;
        if (first_ == end_) return before;
        for (std::int64_t row = std::max<std::int64_t>(share_.first - 1, 0);
             row < std::min(share_.end + 1, rows); ++row) {
            each_tile(row, [&](std::int64_t index) { read(TileSlots(file_, index, kept_), before); });
        }
        std::ranges::stable_sort(before, {}, &KnownMotions::CellMotion::cell);
        return before;
    }
    void add_free_motions() { keep(known_.free_motions()); }
    // Spreads motions; returns those that are new to cells of these rows.
    [[nodiscard]] std::vector<KnownMotions::CellMotion> spread(std::span<const KnownMotions::CellMotion> news) {
        return keep(known_.spread(news));
    }
    void write() {
        std::ranges::stable_sort(found_, {}, &KnownMotions::NewResult::cell);
        for (std::int64_t row = share_.first; row < share_.end; ++row) {
            each_tile(row, [&](std::int64_t index) { write(index); });
        }
    }

  private:
    [[nodiscard]] std::int64_t first_row(std::int64_t tile_row) const {
        return std::min(tile_row * file_.tiling().largest_tile().rows, scene_.rows());
    }
    template <class Take>
    void each_tile(std::int64_t row, Take take) const {
        const std::int64_t columns = file_.tiling().tiles().columns;
        for (std::int64_t index = row * columns; index < (row + 1) * columns; ++index) {
            look_for_stop_request();
            take(index);
        }
    }
    [[nodiscard]] std::int64_t number(const Tile& tile, std::size_t cell) const {
        const std::int64_t row = tile.row + static_cast<std::int64_t>(cell) / tile.extent.columns;
        return row * scene_.columns() + tile.column + static_cast<std::int64_t>(cell) % tile.extent.columns;
    }

    void read(const TileSlots& tile, std::vector<KnownMotions::CellMotion>& before) {
        for (std::size_t i = 0; i < tile.cells.size(); ++i) {
            if (!tile.cells[i].computed) continue;
            const std::int64_t cell = number(tile.tile, i);
            std::vector<KnownMotion> known;
            for (const auto& slot : map_file::own_slots(tile.cells[i], tile.slots[i])) {
                known.push_back(motion_of(slot));
                before.push_back({cell, known.back()});
            }
            const std::int64_t row = cell / scene_.columns();
            if (row >= first_ && row < end_) known_.add(cell, std::move(known));
        }
    }

    std::vector<KnownMotions::CellMotion> keep(const std::vector<KnownMotions::NewResult>& found) {
        std::vector<KnownMotions::CellMotion> news;
        news.reserve(found.size());
        for (const auto& [cell, result] : found) news.push_back({cell, KnownMotions::motion_of(result)});
        found_.insert(found_.end(), found.begin(), found.end());
        return news;
    }

    // Writes the cells whose slots change.
    void write(std::int64_t index) {
        const Tile tile = file_.tiling().tile(index);
        std::optional<TileSlots> slots;
        for (std::int64_t i = 0; i < tile.size(); ++i) {
            const std::int64_t cell = number(tile, static_cast<std::size_t>(i));
            const auto begin = std::ranges::lower_bound(found_, cell, {}, &KnownMotions::NewResult::cell);
            const auto end = std::ranges::upper_bound(found_, cell, {}, &KnownMotions::NewResult::cell);
            if (begin == end) continue;
            if (!slots) slots.emplace(file_, index, kept_);
            add(*slots, static_cast<std::size_t>(i), {begin, end});
        }
        if (slots) file_.write_attractors(index, slots->cells, slots->in_file_order());
    }
    void add(TileSlots& tile, std::size_t i, std::span<const KnownMotions::NewResult> found) const {
        const std::int64_t cell = found.front().cell;
        const std::int64_t row = cell / scene_.columns();
        const std::int64_t column = cell % scene_.columns();
        const scene::Scales scales = scene_.cell(row, column).scales;
        std::vector<quantities::StoredAttractor> known;
        for (const auto& each : found) {
            cell::CellAttractor attractor = attractors::without_share(each.result);
            certify_attractor(scene_.job(), row, column, attractor);
            add_mean_life(scene_, row, column, attractor);
            known.push_back(quantities::in_file_units(attractor, scales));
        }
        std::ranges::stable_sort(known, {}, [](const quantities::StoredAttractor& slot) {
            return std::tuple(slot.regime, slot.period, slot.impacts, slot.peak_force);
        });
        tile.slots[i] = map_file::own_slots(tile.cells[i], tile.slots[i]);
        map_file::add_known(tile.cells[i], tile.slots[i], known, kept_);
    }

    const scene::Scene& scene_;
    MapFile& file_;
    std::int64_t kept_;
    parallel::Share share_;
    std::int64_t first_;
    std::int64_t end_;
    KnownMotions known_;
    std::vector<KnownMotions::NewResult> found_;
};

}  // namespace

void add_known_motions(const parallel::Session& session, const scene::Scene& scene, MapFile& file) {
    if (!has_slots(scene.job())) return;
    MPI_Comm all = session.communicator();
    file.settle();
    Rows rows(scene, file, all);
    std::vector<KnownMotions::CellMotion> news;
    parallel::together(all, [&] {
        news = rows.read();
        rows.add_free_motions();
    });
    do {
        std::vector<KnownMotions::CellMotion> mine;
        parallel::together(all, [&] { mine = rows.spread(news); });
        news = parallel::gather<KnownMotions::CellMotion>(mine, all);
    } while (!news.empty());
    parallel::together(all, [&] { rows.write(); });
}

void add_tiles_to_tell_again(const parallel::Session& session, const job::Job& job, const MapFile& file,
                             parallel::TileSet& missing) {
    if (!has_slots(job)) return;
    const parallel::Share share = parallel::share_of(file.tiling().count(), session.communicator());
    parallel::together(session.communicator(), [&] {
        for (std::int64_t index = share.first; index < share.end; ++index) {
            look_for_stop_request();
            if (missing.has(index)) continue;
            const TileSlots tile(file, index, job.starts.attractors);
            for (std::size_t i = 0; i < tile.cells.size(); ++i) {
                if (!tile.cells[i].computed) continue;
                if (map_file::lost_slots(tile.cells[i], tile.slots[i], tile.kept)) missing.add(index);
            }
        }
    });
    parallel::unite(missing, session.communicator());
}

}  // namespace peterka
