#include "output/tile_bytes.hpp"

#include <xxhash.h>

#include <cstring>

namespace peterka::output {

std::size_t bytes_per_cell(std::span<const Field> fields) {
    std::size_t sum = 0;
    for (const Field& field : fields) sum += bytes_of(field.variable.number);
    return sum;
}

std::vector<std::byte> encode(std::span<const Field> fields, std::span<const StoredCell> cells) {
    std::vector<std::byte> bytes(bytes_per_cell(fields) * cells.size());
    std::byte* next = bytes.data();
    for (const Field& field : fields) {
        visit_number(field.variable.number, [&](auto zero) {
            for (const StoredCell& cell : cells) {
                const auto value = static_cast<decltype(zero)>(field.member.load(cell));
                std::memcpy(next, &value, sizeof value);
                next += sizeof value;
            }
        });
    }
    return bytes;
}

std::vector<StoredCell> decode(std::span<const Field> fields, std::span<const std::byte> bytes,
                               std::size_t count) {
    std::vector<StoredCell> cells(count);
    const std::byte* next = bytes.data();
    for (const Field& field : fields) {
        visit_number(field.variable.number, [&](auto value) {
            for (StoredCell& cell : cells) {
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

}  // namespace peterka::output
