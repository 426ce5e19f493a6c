#include "map_file/tile_bytes.hpp"

#include <xxhash.h>

#include <cstring>

namespace peterka::map_file {

namespace {

template <class Field>
std::size_t bytes_per_entry(std::span<const Field> fields) {
    std::size_t sum = 0;
    for (const Field& field : fields) sum += hdf5::bytes_of(field.variable.number);
    return sum;
}

template <class Field, class Entry>
std::vector<std::byte> bytes_of(std::span<const Field> fields, std::span<const Entry> entries) {
    std::vector<std::byte> bytes(bytes_per_entry(fields) * entries.size());
    std::byte* next = bytes.data();
    for (const Field& field : fields) {
        hdf5::visit_number(field.variable.number, [&](auto zero) {
            for (const Entry& entry : entries) {
                const auto value = static_cast<decltype(zero)>(field.quantity->load(entry));
                std::memcpy(next, &value, sizeof value);
                next += sizeof value;
            }
        });
    }
    return bytes;
}

template <class Entry, class Field>
std::vector<Entry> entries_of(std::span<const Field> fields, std::span<const std::byte> bytes,
                              std::size_t count) {
    std::vector<Entry> entries(count);
    const std::byte* next = bytes.data();
    for (const Field& field : fields) {
        hdf5::visit_number(field.variable.number, [&](auto value) {
            for (Entry& entry : entries) {
                std::memcpy(&value, next, sizeof value);
                next += sizeof value;
                field.quantity->store(entry, static_cast<double>(value));
            }
        });
    }
    return entries;
}

}  // namespace

std::size_t bytes_per_cell(std::span<const quantities::Field> fields) {
    return bytes_per_entry(fields);
}

std::size_t bytes_per_attractor(std::span<const quantities::AttractorField> fields) {
    return bytes_per_entry(fields);
}

std::vector<std::byte> encode(std::span<const quantities::Field> fields,
                              std::span<const quantities::StoredCell> cells) {
    return bytes_of(fields, cells);
}

std::vector<std::byte> encode(std::span<const quantities::AttractorField> fields,
                              std::span<const quantities::StoredAttractor> attractors) {
    return bytes_of(fields, attractors);
}

std::vector<std::byte> encode(std::span<const quantities::OutcomeField> fields,
                              std::span<const quantities::StoredOutcome> outcomes) {
    return bytes_of(fields, outcomes);
}

std::vector<quantities::StoredCell> decode(std::span<const quantities::Field> fields,
                                           std::span<const std::byte> bytes, std::size_t count) {
    return entries_of<quantities::StoredCell>(fields, bytes, count);
}

std::vector<quantities::StoredAttractor> decode(std::span<const quantities::AttractorField> fields,
                                                std::span<const std::byte> bytes, std::size_t count) {
    return entries_of<quantities::StoredAttractor>(fields, bytes, count);
}

std::vector<quantities::StoredOutcome> decode(std::span<const quantities::OutcomeField> fields,
                                              std::span<const std::byte> bytes, std::size_t count) {
    return entries_of<quantities::StoredOutcome>(fields, bytes, count);
}

std::uint64_t checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace peterka::map_file
