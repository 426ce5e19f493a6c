#include "map_file/number_attractors.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "findings/attractors.hpp"
#include "hdf5/block.hpp"
#include "map_file/layout.hpp"
#include "map_file/tile_bytes.hpp"
#include "parallel/checked.hpp"
#include "parallel/collective.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::map_file {

namespace {

// A cell that no known attractor explains, and its place in the order of tiles and of cells inside a tile.
struct Candidate {
    std::int64_t place = std::numeric_limits<std::int64_t>::max();
    quantities::StoredCell cell;
};

// Goes through this rank's share once, stopping at each cell that is still unexplained.
class UnexplainedCells {
  public:
    UnexplainedCells(const TileStore& tiles, parallel::Share share)
        : tiles_(tiles), next_tile_(share.first), end_(share.end) {}

    [[nodiscard]] Candidate next(std::span<const findings::Attractor> known) {
        for (;; ++position_) {
            if (position_ == cells_.size() && !load()) return {};
            const quantities::StoredCell& cell = cells_[position_];
            if (findings::has_attractor(cell) && findings::row_of(known, cell) == findings::no_attractor)
                return {place(), cell};
        }
    }

  private:
    bool load() {
        if (next_tile_ == end_) return false;
        look_for_stop_request();
        cells_ = tiles_.read(tiles_.tiling().tile(next_tile_++));
        position_ = 0;
        return true;
    }
    [[nodiscard]] std::int64_t place() const {
        constexpr std::int64_t largest_tile = parallel::tile_extent.rows * parallel::tile_extent.columns;
        return next_tile_ * largest_tile + static_cast<std::int64_t>(position_);
    }

    const TileStore& tiles_;
    std::int64_t next_tile_;
    std::int64_t end_;
    std::vector<quantities::StoredCell> cells_;
    std::size_t position_ = 0;
};

std::vector<findings::Attractor> find_attractors(const TileStore& tiles, parallel::Share share,
                                                 MPI_Comm communicator) {
    std::vector<findings::Attractor> known;
    UnexplainedCells unexplained(tiles, share);
    while (std::ssize(known) < attractor_capacity) {
        Candidate mine;
        parallel::together(communicator, [&] { mine = unexplained.next(known); });
        const std::vector<Candidate> all = parallel::gather<Candidate>(std::span(&mine, 1), communicator);
        const Candidate lowest = *std::ranges::min_element(all, {}, &Candidate::place);
        if (lowest.place == Candidate{}.place) break;
        known.push_back({lowest.cell, 0});
    }
    findings::sort_canonically(known);
    return known;
}

// Writes the rows of this rank's cells, counts them in the table and returns the number of cells without a row.
std::int64_t write_rows(const hdf5::OpenMap& map, const TileStore& tiles, parallel::Share share,
                        std::vector<findings::Attractor>& table) {
    const hdf5::Stored attractor(map, path::attractor, hdf5::Number::int32);
    std::int64_t left_over = 0;
    for (std::int64_t index = share.first; index < share.end; ++index) {
        look_for_stop_request();
        const parallel::Tile tile = tiles.tiling().tile(index);
        std::vector<std::int32_t> rows;
        for (const quantities::StoredCell& cell : tiles.read(tile)) {
            const std::int32_t row = rows.emplace_back(findings::row_of(table, cell));
            if (row != findings::no_attractor) ++table[static_cast<std::size_t>(row)].cells;
            if (row == findings::no_attractor && findings::has_attractor(cell)) ++left_over;
        }
        attractor.write(hdf5::Block(tile), rows.data());
    }
    return left_over;
}

void write_column(const hdf5::OpenMap& map, const std::string& path, hdf5::Number number, const void* values,
                  std::size_t count) {
    if (count == 0) return;
    hdf5::Stored(map, path, number).write(hdf5::Block(0, static_cast<std::int64_t>(count)), values);
}

std::string path_of(const quantities::Field& column) {
    return std::string("/attractors/") + column.variable.name;
}

void write_table(const hdf5::OpenMap& map, std::span<const findings::Attractor> table) {
    std::vector<quantities::StoredCell> cells;
    std::vector<std::int64_t> counts;
    for (const findings::Attractor& attractor : table) {
        cells.push_back(attractor.cell);
        counts.push_back(attractor.cells);
    }
    for (const quantities::Field& field : quantities::attractor_fields()) {
        const std::vector<std::byte> column = encode(std::span(&field, 1), cells);
        write_column(map, path_of(field), field.variable.number, column.data(), table.size());
    }
    write_column(map, path::attractor_cells, hdf5::Number::int64, counts.data(), table.size());
    hdf5::put_number(map, path::attractor_count, hdf5::Number::int32, static_cast<double>(table.size()));
}

std::int64_t sum(std::int64_t mine, MPI_Comm communicator) {
    parallel::checked("MPI_Allreduce",
                      MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT64_T, MPI_SUM, communicator));
    return mine;
}

}  // namespace

std::int64_t number_attractors(const hdf5::OpenMap& map, const TileStore& tiles, MPI_Comm communicator) {
    const parallel::Share share = parallel::share_of(tiles.tiling().count(), communicator);
    std::vector<findings::Attractor> table = find_attractors(tiles, share, communicator);
    std::int64_t left_over = 0;
    parallel::together(communicator, [&] { left_over = write_rows(map, tiles, share, table); });
    for (findings::Attractor& attractor : table) attractor.cells = sum(attractor.cells, communicator);
    parallel::on_first_rank(communicator, [&] { write_table(map, table); });
    return sum(left_over, communicator);
}

std::vector<findings::Attractor> read_attractor_table(const hdf5::OpenMap& map) {
    const auto rows =
        static_cast<std::int64_t>(hdf5::get_number(map, path::attractor_count, hdf5::Number::int32));
    if (rows < 1) return {};
    const hdf5::Block all(0, rows);
    std::vector<std::byte> columns;
    const std::vector<quantities::Field> fields = quantities::attractor_fields();
    for (const quantities::Field& field : fields) {
        const hdf5::Stored column(map, path_of(field), field.variable.number);
        const std::size_t before = columns.size();
        columns.resize(before + column.bytes(all));
        column.read(all, columns.data() + before);
    }
    std::vector<findings::Attractor> table;
    for (const quantities::StoredCell& cell : decode(fields, columns, static_cast<std::size_t>(rows))) {
        table.push_back({cell, 0});
    }
    std::vector<std::int64_t> counts(table.size());
    hdf5::Stored(map, path::attractor_cells, hdf5::Number::int64).read(all, counts.data());
    for (std::size_t row = 0; row < table.size(); ++row) table[row].cells = counts[row];
    return table;
}

}  // namespace peterka::map_file
