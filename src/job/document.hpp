// A TOML text as plain values, each with its location. Only the .cpp file depends on the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "job/faults.hpp"

namespace peterka::job {

struct Value;
struct Entry;

struct Table {
    std::vector<Entry> entries;
    [[nodiscard]] const Value* find(std::string_view name) const;
    [[nodiscard]] Entry& entry(std::string_view name, const Location& where);  // existing, or a new one
};

struct Array {
    std::vector<Value> values;
};

struct BareWord {  // in an override: not a TOML value, taken as text where text is expected
    std::string text;
};

struct DateOrTime {
    std::string text;
};

struct Value {
    Location where;
    std::variant<Table, Array, std::string, BareWord, std::int64_t, double, bool, DateOrTime> content;

    template <typename Content>
    [[nodiscard]] const Content* as() const {
        return std::get_if<Content>(&content);
    }
    [[nodiscard]] std::string text() const;                // shortened, as in a file
    [[nodiscard]] std::string_view type_in_words() const;  // "text", "an integer", ...
};

struct Entry {
    std::string name;
    Location where;  // of the key
    Value value;
};

// No job has longer lines, and deeply nested ones would exhaust the stack of a recursive parser.
inline constexpr std::size_t longest_line = 4096;

// Throws JobFaults with the first syntax error alone: nothing after it can be read. `number` is the file's
// Location::file.
[[nodiscard]] Value parse_document(std::string_view text, const std::string& file, std::uint32_t number = 0);

// The right-hand side of an override; a text that is not a TOML value becomes a BareWord. Throws
// std::invalid_argument with the complaint if it is neither.
[[nodiscard]] Value parse_value(std::string_view text, const Location& where);

}  // namespace peterka::job
