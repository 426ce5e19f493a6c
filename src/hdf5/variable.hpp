// What a reader is told about one dataset: name, kind of number, unit and meaning.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"

namespace peterka::hdf5 {

enum class Number { int8, int32, int64, uint64, float64, text };

// Every text has the same room, reserved when the file is made; longer ones are cut [bytes].
inline constexpr std::size_t text_capacity = 4096;

// Names of the values 0, 1, 2, ..., or from first_flag on, of a variable that tells classes apart; empty for a
// measured quantity.
using Flags = std::span<const char* const>;

struct Variable {
    const char* name;
    Number number;
    double fill;        // value before anything is written; exact in each kind of number used
    const char* units;  // "" where a unit makes no sense
    const char* long_name;
    Flags flags = {};
    int first_flag = 0;
};

[[nodiscard]] std::size_t bytes_of(Number number);

// How a number lies in the file: little-endian at any machine; a text as UTF-8 of fixed capacity.
[[nodiscard]] TypeId file_type(const Checked& check, Number number);
// How this machine holds it; HDF5's own identifier, not to be closed. There is none for text.
[[nodiscard]] hid_t memory_type(Number number);

// Calls `visitor` with a zero of the C++ type of a number: the one switch from kinds of numbers to types.
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
