// The metadata of one dataset: name, kind of number, unit and meaning.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"

namespace peterka::hdf5 {

enum class Number { int8, int32, int64, uint64, float64, text };

// Capacity of every text, reserved when the file is created; longer texts are truncated [bytes].
inline constexpr std::size_t text_capacity = 4096;

// Names of the values 0, 1, 2, ..., or from first_flag on, of a categorical variable; empty for a measured
// quantity.
using Flags = std::span<const char* const>;

struct Variable {
    const char* name;
    Number number;
    double fill;        // value before anything is written; exact in each kind of number used
    const char* units;  // "" if it has no unit
    const char* long_name;
    Flags flags = {};
    int first_flag = 0;
};

[[nodiscard]] std::size_t bytes_of(Number number);

// The type in the file: little-endian on every machine; a text as UTF-8 of fixed capacity.
[[nodiscard]] TypeId file_type(const Checked& check, Number number);
// The type in memory: HDF5's own identifier, not to be closed. There is none for text.
[[nodiscard]] hid_t memory_type(Number number);

// Calls `visitor` with a zero of a number's C++ type: the only switch from kinds of numbers to types.
template <class Visitor>
decltype(auto) visit_number(Number number, Visitor&& visitor) {
    switch (number) {
        case Number::int8:
            return visitor(std::int8_t{});
        case Number::int32:
            return visitor(std::int32_t{});
        case Number::int64:
            return visitor(std::int64_t{});
        case Number::uint64:
            return visitor(std::uint64_t{});
        case Number::text:
            return visitor(char{});
        case Number::float64:
            break;
    }
    return visitor(double{});
}

}  // namespace peterka::hdf5
