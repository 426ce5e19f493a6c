#include "job/sobol.hpp"

#include <array>

#include "support/expect.hpp"

namespace peterka::job {
namespace {

// A row of the table of Joe and Kuo (new-joe-kuo-6.21201): the degree of a primitive polynomial, its inner
// coefficients as bits, and the first direction numbers.
struct Row {
    unsigned degree;
    unsigned coefficients;
    std::array<std::uint32_t, 6> first;
};
constexpr std::array<Row, sobol_dimensions - 1> rows{{{1, 0, {1}},
                                                      {2, 1, {1, 3}},
                                                      {3, 1, {1, 3, 1}},
                                                      {3, 2, {1, 1, 1}},
                                                      {4, 1, {1, 1, 3, 3}},
                                                      {4, 4, {1, 3, 5, 13}},
                                                      {5, 2, {1, 1, 5, 5, 17}},
                                                      {5, 4, {1, 1, 5, 5, 5}},
                                                      {5, 7, {1, 1, 7, 11, 19}},
                                                      {5, 11, {1, 1, 5, 1, 1}},
                                                      {5, 13, {1, 1, 1, 3, 11}}}};

constexpr unsigned bits = 32;
using Directions = std::array<std::uint32_t, bits>;

constexpr Directions directions_of(const Row& row) {
    Directions directions{};
    for (unsigned i = 0; i < bits; ++i) {
        if (i < row.degree) {
            directions[i] = row.first[i] << (bits - 1 - i);
            continue;
        }
        const std::uint32_t last = directions[i - row.degree];
        directions[i] = last ^ (last >> row.degree);
        for (unsigned k = 1; k < row.degree; ++k) {
            const bool is_in = ((row.coefficients >> (row.degree - 1 - k)) & 1U) != 0;
            if (is_in) directions[i] ^= directions[i - k];
        }
    }
    return directions;
}

constexpr std::array<Directions, sobol_dimensions> all_directions = [] {
    std::array<Directions, sobol_dimensions> all{};
    for (unsigned i = 0; i < bits; ++i) all[0][i] = std::uint32_t{1} << (bits - 1 - i);
    for (std::size_t row = 0; row < rows.size(); ++row) all[row + 1] = directions_of(rows[row]);
    return all;
}();

}  // namespace

std::uint32_t sobol(std::uint32_t n, std::size_t dimension) {
    PETERKA_EXPECT(dimension < sobol_dimensions);
    std::uint32_t point = 0;
    for (const std::uint32_t direction : all_directions[dimension]) {
        if ((n & 1U) != 0) point ^= direction;
        n >>= 1U;
    }
    return point;
}

}  // namespace peterka::job
