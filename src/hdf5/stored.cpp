#include "hdf5/stored.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "support/errors.hpp"

namespace peterka::hdf5 {

// Files hold numbers in this machine's byte order.
static_assert(std::endian::native == std::endian::little);

namespace {

Storage storage_of(const OpenMap& map, const std::string& path, Number number, hid_t dataset) {
    auto storage = Storage::of(map.check, dataset);
    if (storage && storage->bytes_per_value() == bytes_of(number)) return *storage;
    throw Failure(ExitCode::output, fmt::format("{}: is damaged: dataset {} has no storage of its own",
                                                map.check.path().string(), path));
}

void write_scalar(const Checked& check, hid_t dataset, hid_t type, const void* value) {
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value), "H5Dwrite");
}

// Bypasses selections, for which HDF5 searches for whatever else they may touch: a seventh of the instructions.
void write_chunk(const Checked& check, hid_t dataset, const Block& chunk, std::size_t bytes,
                 const void* values) {
    constexpr std::uint32_t filters_left_out = 0;
    check(H5Dwrite_chunk(dataset, H5P_DEFAULT, filters_left_out, chunk.offset(), bytes, values),
          "H5Dwrite_chunk");
}

const Block single(0, 1);

}  // namespace

Stored::Stored(const OpenMap& map, const std::string& path, Number number)
    : map_(map),
      path_(path),
      number_(number),
      dataset_(map.check(H5Dopen2(map.file, path.c_str(), H5P_DEFAULT), "H5Dopen2")),
      storage_(storage_of(map, path, number, dataset_.id())) {}

std::size_t Stored::bytes(const Block& block) const {
    std::size_t sum = bytes_of(number_);
    for (int i = 0; i < block.rank(); ++i) sum *= static_cast<std::size_t>(block.count()[i]);
    return sum;
}

void Stored::write(const Block& block, const void* values) const {
    const std::span written(static_cast<const std::byte*>(values), bytes(block));
    if (hand_over(block, values) && holds(block, written)) return;
    const std::byte* next = written.data();
    storage_.each_piece(block, [&](std::uint64_t offset, std::size_t bytes) {
        map_.disk.write(offset, {next, bytes});
        next += bytes;
    });
    if (holds(block, written)) return;
    throw Failure(
        ExitCode::output,
        fmt::format("{}: dataset {} doesn't hold what was just written to it; its disk may be failing.",
                    map_.check.path().string(), path_));
}

bool Stored::hand_over(const Block& block, const void* values) const {
    try {
        if (storage_.is_scalar()) {
            const TypeId type = file_type(map_.check, number_);
            write_scalar(map_.check, dataset_.id(), type.id(), values);
        } else if (storage_.is_whole_chunk(block)) {
            write_chunk(map_.check, dataset_.id(), block, bytes(block), values);
        } else {
            write_block(map_.check, dataset_.id(), number_, block, values);
        }
        return true;
    } catch (const Failure&) {  // the write by a system call reports the reason
        return false;
    }
}

bool Stored::holds(const Block& block, std::span<const std::byte> values) const {
    std::vector<std::byte> there(values.size());
    read(block, there.data());
    return std::ranges::equal(there, values);
}

void Stored::read(const Block& block, void* values) const {
    auto* next = static_cast<std::byte*>(values);
    storage_.each_piece(block, [&](std::uint64_t offset, std::size_t bytes) {
        map_.disk.read(offset, {next, bytes});
        next += bytes;
    });
}

void put_number(const OpenMap& map, const char* path, Number number, double value) {
    visit_number(number, [&](auto zero) {
        const auto exact = static_cast<decltype(zero)>(value);
        Stored(map, path, number).write(single, &exact);
    });
}

double get_number(const OpenMap& map, const char* path, Number number) {
    return visit_number(number, [&](auto value) {
        Stored(map, path, number).read(single, &value);
        return static_cast<double>(value);
    });
}

void put_text(const OpenMap& map, const char* path, const std::string& text) {
    Stored(map, path, Number::text).write(single, padded_text(text).data());
}

}  // namespace peterka::hdf5
