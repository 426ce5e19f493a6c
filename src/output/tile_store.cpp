#include "output/tile_store.hpp"

#include <fmt/format.h>

#include <utility>

#include "output/block.hpp"
#include "output/layout.hpp"
#include "output/samples.hpp"
#include "output/tile_bytes.hpp"
#include "support/errors.hpp"

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
      samples_(job.kind == job::Kind::sweep ? job.sweep.samples : 0),
      checksum_(open(check_, file, path::checksum)),
      done_(open(check_, file, path::done)),
      seconds_(open(check_, file, path::tile_seconds)),
      rank_(open(check_, file, path::tile_rank)) {
    for (const Field& field : fields_) datasets_.push_back(open(check_, file, field.variable.name));
    if (samples_ == 0) return;
    for (const Variable& variable : sample_variables) datasets_.push_back(open(check_, file, variable.name));
}

std::vector<TileStore::Part> TileStore::parts(const parallel::Tile& tile) const {
    const auto cells = static_cast<std::size_t>(tile.size());
    std::vector<Part> parts;
    for (std::size_t i = 0; i < datasets_.size(); ++i) {
        const bool sampled = i >= fields_.size();
        const Number number = sampled ? Number::float64 : fields_[i].variable.number;
        const std::size_t values = sampled ? cells * static_cast<std::size_t>(samples_) : cells;
        parts.push_back({datasets_[i].id(), number, sampled ? Block(tile, samples_) : Block(tile),
                         values * bytes_of(number)});
    }
    return parts;
}

void TileStore::write(const parallel::Tile& tile, std::span<const StoredCell> cells, const TileOrigin& origin,
                      std::span<const double> samples) {
    std::vector<std::byte> bytes = encode(fields_, cells);
    const auto sampled = std::as_bytes(samples);
    bytes.insert(bytes.end(), sampled.begin(), sampled.end());
    try {
        write_whole(tile, bytes, origin);
    } catch (const Failure& failure) {
        throw Failure(failure.code(), fmt::format("{} Finished tiles are kept: run the same command again when "
                                                  "the file can be written.",
                                                  failure.what()));
    }
}

void TileStore::write_whole(const parallel::Tile& tile, std::span<const std::byte> bytes,
                            const TileOrigin& origin) {
    const std::byte* next = bytes.data();
    for (const Part& part : parts(tile)) {
        write_block(check_, part.dataset, part.number, part.block, next);
        next += part.bytes;
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
    const std::vector<Part> parts = this->parts(tile);
    std::size_t size = 0;
    for (const Part& part : parts) size += part.bytes;
    std::vector<std::byte> bytes(size);
    std::byte* next = bytes.data();
    for (const Part& part : parts) {
        read_block(check_, part.dataset, part.number, part.block, next);
        next += part.bytes;
    }
    return bytes;
}

}  // namespace peterka::output
