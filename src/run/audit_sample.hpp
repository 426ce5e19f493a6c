// Which cells of a map are audited: a random sample determined by the numbers of cells alone.
#pragma once

#include <cstdint>

namespace peterka {

// A well-mixed hash of a counter (splitmix64, Steele et al. 2014).
constexpr std::uint64_t mixed(std::uint64_t counter) {
    std::uint64_t z = (counter + 1) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

// The cell of sample `index` out of `samples` <= `cells`: one at random from each of `samples` equal stretches
// of cells, so that the sample is spread over the whole map and no cell occurs twice. Each `draw` gives another
// cell.
constexpr std::int64_t audited_cell(std::int64_t index, std::int64_t samples, std::int64_t cells,
                                    std::int64_t draw = 0) {
    const auto start_of = [&](std::int64_t stretch) {  // stretch * cells / samples without its overflow
        return stretch * (cells / samples) + stretch * (cells % samples) / samples;
    };
    const std::int64_t first = start_of(index);
    const std::int64_t length = start_of(index + 1) - first;
    const std::uint64_t random =
        mixed(static_cast<std::uint64_t>(index) ^ (static_cast<std::uint64_t>(draw) << 48U));
    return first + static_cast<std::int64_t>(random % static_cast<std::uint64_t>(length));
}

}  // namespace peterka
