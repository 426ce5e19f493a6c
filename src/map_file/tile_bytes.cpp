#include "map_file/tile_bytes.hpp"

#include <xxhash.h>

#include <cstring>

namespace peterka::map_file {

std::size_t bytes_per_cell(std::span<const quantities::Field> fields) {
    std::size_t sum = 0;
    for (const quantities::Field& field : fields) sum += hdf5::bytes_of(field.variable.number);
    return sum;
}

std::vector<std::byte> encode(std::span<const quantities::Field> fields,
                              std::span<const quantities::StoredCell> cells) {
    std::vector<std::byte> bytes(bytes_per_cell(fields) * cells.size());
    std::byte* next = bytes.data();
    for (const quantities::Field& field : fields) {
        hdf5::visit_number(field.variable.number, [&](auto zero) {
            for (const quantities::StoredCell& cell : cells) {
                const auto value = static_cast<decltype(zero)>(field.member.load(cell));
                std::memcpy(next, &value, sizeof value);
                next += sizeof value;
            }
        });
    }
    return bytes;
}

std::vector<quantities::StoredCell> decode(std::span<const quantities::Field> fields,
                                           std::span<const std::byte> bytes, std::size_t count) {
    std::vector<quantities::StoredCell> cells(count);
    const std::byte* next = bytes.data();
    for (const quantities::Field& field : fields) {
        hdf5::visit_number(field.variable.number, [&](auto value) {
            for (quantities::StoredCell& cell : cells) {
                std::memcpy(&value, next, sizeof value);
                next += sizeof value;
                field.member.store(cell, static_cast<double>(value));
            }
        });
    }
    return cells;
}

std::uint64_t checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace peterka::map_file
