#include "output/tile_store.hpp"

#include <utility>

#include "output/block.hpp"
#include "output/layout.hpp"
#include "output/tile_bytes.hpp"

namespace peterka::output {

namespace {

DatasetId open(const Checked& check, hid_t file, const char* path) {
    return DatasetId(check(H5Dopen2(file, path, H5P_DEFAULT), "H5Dopen2"));
}

}  // namespace

TileStore::TileStore(Checked check, hid_t file, const job::Job& job)
    : check_(std::move(check)),
      tiling_(output::tiling(job)),
      fields_(stored_fields(job)),
      checksum_(open(check_, file, path::checksum)),
      done_(open(check_, file, path::done)),
      seconds_(open(check_, file, path::tile_seconds)),
      rank_(open(check_, file, path::tile_rank)) {
    for (const Field& field : fields_) datasets_.push_back(open(check_, file, field.variable.name));
}

void TileStore::write(const parallel::Tile& tile, std::span<const StoredCell> cells, const TileOrigin& origin) {
    const std::vector<std::byte> bytes = encode(fields_, cells);
    const std::byte* next = bytes.data();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const Number number = fields_[i].variable.number;
        write_block(check_, datasets_[i].id(), number, Block(tile), next);
        next += cells.size() * bytes_of(number);
    }
    const Block entry(tile.index, 1);
    write_block(check_, seconds_.id(), Number::float64, entry, &origin.seconds);
    write_block(check_, rank_.id(), Number::int32, entry, &origin.rank);
    const std::uint64_t sum = checksum(bytes);
    const std::int8_t done = 1;
    write_block(check_, checksum_.id(), Number::uint64, entry, &sum);
    write_block(check_, done_.id(), Number::int8, entry, &done);
}

std::vector<StoredCell> TileStore::read(const parallel::Tile& tile) const {
    return decode(fields_, read_bytes(tile), static_cast<std::size_t>(tile.size()));
}

TileState TileStore::state(const parallel::Tile& tile) const {
    std::int8_t done = 0;
    read_block(check_, done_.id(), Number::int8, Block(tile.index, 1), &done);
    if (done != 1) return TileState::missing;
    std::uint64_t sum = 0;
    read_block(check_, checksum_.id(), Number::uint64, Block(tile.index, 1), &sum);
    return checksum(read_bytes(tile)) == sum ? TileState::whole : TileState::damaged;
}

double TileStore::seconds(const parallel::Tile& tile) const {
    double seconds = 0;
    read_block(check_, seconds_.id(), Number::float64, Block(tile.index, 1), &seconds);
    return seconds;
}

std::vector<std::byte> TileStore::read_bytes(const parallel::Tile& tile) const {
    const auto cells = static_cast<std::size_t>(tile.size());
    std::vector<std::byte> bytes(cells * bytes_per_cell(fields_));
    std::byte* next = bytes.data();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const Number number = fields_[i].variable.number;
        read_block(check_, datasets_[i].id(), number, Block(tile), next);
        next += cells * bytes_of(number);
    }
    return bytes;
}

}  // namespace peterka::output
