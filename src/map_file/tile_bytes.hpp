// The bytes of one tile: what is written to the file, read back and covered by the tile's checksum.
//
// Field after field in the order of the job's fields, each row by row inside the tile, in the number type of
// the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quantities/fields.hpp"

namespace peterka::map_file {

[[nodiscard]] std::vector<std::byte> encode(std::span<const quantities::Field> fields,
                                            std::span<const quantities::StoredCell> cells);

[[nodiscard]] std::vector<std::byte> encode(std::span<const quantities::AttractorField> fields,
                                            std::span<const quantities::StoredAttractor> attractors);

[[nodiscard]] std::vector<std::byte> encode(std::span<const quantities::OutcomeField> fields,
                                            std::span<const quantities::StoredOutcome> outcomes);

// The inverse, for `count` cells or attractors: members without a stored field keep their defaults.
[[nodiscard]] std::vector<quantities::StoredCell> decode(std::span<const quantities::Field> fields,
                                                         std::span<const std::byte> bytes, std::size_t count);
[[nodiscard]] std::vector<quantities::StoredAttractor> decode(
    std::span<const quantities::AttractorField> fields, std::span<const std::byte> bytes, std::size_t count);

[[nodiscard]] std::vector<quantities::StoredOutcome> decode(std::span<const quantities::OutcomeField> fields,
                                                            std::span<const std::byte> bytes,
                                                            std::size_t count);

// Bytes that one cell, or one of its attractors, takes in all fields together.
[[nodiscard]] std::size_t bytes_per_cell(std::span<const quantities::Field> fields);
[[nodiscard]] std::size_t bytes_per_attractor(std::span<const quantities::AttractorField> fields);

// XXH3, 64 bits.
[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace peterka::map_file
