#include "map_file/tile_store.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "hdf5/block.hpp"
#include "map_file/layout.hpp"
#include "map_file/samples.hpp"
#include "map_file/tile_bytes.hpp"
#include "support/errors.hpp"
#include "support/expect.hpp"

namespace peterka::map_file {

TileStore::TileStore(const hdf5::OpenMap& map, const job::Job& job)
    : map_(map),
      tiling_(map_file::tiling(job)),
      fields_(quantities::stored_fields(job)),
      samples_(job.kind == job::Kind::sweep ? job.sweep.samples : 0),
      attractor_fields_(quantities::stored_attractor_fields(job)),
      kept_(job.starts.attractors),
      outcome_fields_(quantities::stored_outcome_fields(job)),
      checksum_(map, path::checksum, hdf5::Number::uint64),
      done_(map, path::done, hdf5::Number::int8),
      seconds_(map, path::tile_seconds, hdf5::Number::float64),
      rank_(map, path::tile_rank, hdf5::Number::int32) {
    const auto add = [&](const hdf5::Variable& variable) {
        datasets_.emplace_back(map, std::string("/") + variable.name, variable.number);
    };
    for (const quantities::Field& field : fields_) add(field.variable);
    for (const quantities::AttractorField& field : attractor_fields_) add(field.variable);
    for (const quantities::OutcomeField& field : outcome_fields_) add(field.variable);
    for (const hdf5::Variable& variable : stored_sample_variables(job)) add(variable);
}

std::vector<TileStore::Part> TileStore::parts(const parallel::Tile& tile) const {
    std::vector<Part> parts;
    const auto add = [&](std::size_t end, const hdf5::Block& block) {
        for (std::size_t i = parts.size(); i < end; ++i)
            parts.push_back({datasets_[i], block, datasets_[i].bytes(block)});
    };
    add(fields_.size(), hdf5::Block(tile));
    add(parts.size() + attractor_fields_.size(), hdf5::Block(kept_, tile));
    add(parts.size() + outcome_fields_.size(), hdf5::Block(cell::kept_outcomes, tile));
    add(datasets_.size(), hdf5::Block(tile, samples_));
    return parts;
}

void TileStore::write(const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
                      const TileOrigin& origin, std::span<const std::byte> several) {
    PETERKA_EXPECT(std::ssize(cells) == tile.size());
    std::vector<std::byte> bytes = encode(fields_, cells);
    bytes.insert(bytes.end(), several.begin(), several.end());
    try {
        write_whole(tile, bytes, origin);
    } catch (const Failure& failure) {
        throw Failure(failure.code(), fmt::format("{} Finished tiles are kept: run the same command again when "
                                                  "the file can be written.",
                                                  failure.what()));
    }
}

void TileStore::write_again(const parallel::Tile& tile, std::span<const quantities::StoredCell> cells,
                            std::span<const std::byte> several) {
    const hdf5::Block entry(tile.index, 1);
    TileOrigin origin{.seconds = seconds(tile)};
    rank_.read(entry, &origin.rank);
    const std::int8_t not_done = 0;
    done_.write(entry, &not_done);
    write(tile, cells, origin, several);
}

void TileStore::write_whole(const parallel::Tile& tile, std::span<const std::byte> bytes,
                            const TileOrigin& origin) {
    const std::byte* next = bytes.data();
    for (const Part& part : parts(tile)) {
        PETERKA_EXPECT(next + part.bytes <= bytes.data() + bytes.size());
        part.stored.write(part.block, next);
        next += part.bytes;
    }
    PETERKA_EXPECT(next == bytes.data() + bytes.size());
    const hdf5::Block entry(tile.index, 1);
    seconds_.write(entry, &origin.seconds);
    rank_.write(entry, &origin.rank);
    const std::uint64_t sum = checksum(bytes);
    const std::int8_t done = 1;
    checksum_.write(entry, &sum);
    done_.write(entry, &done);
}

std::vector<quantities::StoredCell> TileStore::read(const parallel::Tile& tile) const {
    return decode(fields_, read_whole(tile), static_cast<std::size_t>(tile.size()));
}

std::vector<quantities::StoredAttractor> TileStore::read_attractors(const parallel::Tile& tile) const {
    if (attractor_fields_.empty()) return {};
    const std::vector<std::byte> bytes = read_whole(tile);
    const auto cells = static_cast<std::size_t>(tile.size());
    return decode(attractor_fields_, std::span(bytes).subspan(bytes_per_cell(fields_) * cells),
                  static_cast<std::size_t>(kept_) * cells);
}

std::vector<quantities::StoredOutcome> TileStore::read_outcomes(const parallel::Tile& tile) const {
    if (outcome_fields_.empty()) return {};
    const std::vector<std::byte> bytes = read_whole(tile);
    const auto cells = static_cast<std::size_t>(tile.size());
    const std::size_t before =
        bytes_per_cell(fields_) + static_cast<std::size_t>(kept_) * bytes_per_attractor(attractor_fields_);
    return decode(outcome_fields_, std::span(bytes).subspan(before * cells),
                  static_cast<std::size_t>(cell::kept_outcomes) * cells);
}

std::vector<std::byte> TileStore::read_whole(const parallel::Tile& tile) const {
    std::vector<std::byte> bytes = read_bytes(tile);
    if (is_done(tile) && !fits(tile, bytes)) {
        throw Failure(
            ExitCode::output,
            fmt::format("{}: the tile at row {}, column {} is not what was written there (wrong checksum). "
                        "Run the same command again: it computes this tile anew.",
                        map_.check.path().string(), tile.row, tile.column));
    }
    return bytes;
}

quantities::StoredCell TileStore::read_cell(const parallel::CellIndex& cell) const {
    PETERKA_EXPECT(0 <= cell.row && cell.row < tiling_.grid().rows);
    PETERKA_EXPECT(0 <= cell.column && cell.column < tiling_.grid().columns);
    const parallel::Tile tile = tiling_.tile(tiling_.index_at(cell));
    const std::int64_t inside = (cell.row - tile.row) * tile.extent.columns + cell.column - tile.column;
    return read(tile)[static_cast<std::size_t>(inside)];
}

TileState TileStore::state(const parallel::Tile& tile) const {
    if (!is_done(tile)) return TileState::missing;
    return fits(tile, read_bytes(tile)) ? TileState::whole : TileState::damaged;
}

bool TileStore::is_done(const parallel::Tile& tile) const {
    std::int8_t done = 0;
    done_.read(hdf5::Block(tile.index, 1), &done);
    return done == 1;
}

bool TileStore::fits(const parallel::Tile& tile, std::span<const std::byte> bytes) const {
    std::uint64_t sum = 0;
    checksum_.read(hdf5::Block(tile.index, 1), &sum);
    return checksum(bytes) == sum;
}

double TileStore::seconds(const parallel::Tile& tile) const {
    double seconds = 0;
    seconds_.read(hdf5::Block(tile.index, 1), &seconds);
    return seconds;
}

std::vector<std::byte> TileStore::read_bytes(const parallel::Tile& tile) const {
    PETERKA_EXPECT(0 <= tile.index && tile.index < tiling_.count());
    const std::vector<Part> parts = this->parts(tile);
    std::size_t size = 0;
    for (const Part& part : parts) size += part.bytes;
    std::vector<std::byte> bytes(size);
    std::byte* next = bytes.data();
    for (const Part& part : parts) {
        part.stored.read(part.block, next);
        next += part.bytes;
    }
    return bytes;
}

}  // namespace peterka::map_file
