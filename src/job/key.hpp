// What is said about a key or a table wherever it is read, asked for or written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/range.hpp"

namespace peterka::job {

struct Key {
    std::string_view name;
    std::string_view meaning;       // with its unit in brackets
    std::string_view example = {};  // a value, for a key that must be given; a key without one has a default
    bool is_identity = true;        // whether two runs that differ here are different jobs
    bool is_written = true;         // false: it names what is written instead

    [[nodiscard]] bool is_required() const { return !example.empty(); }
};

// One of two keys of which exactly one is given, or none where the first has a default.
struct Alternative {
    Key key;
    std::optional<double>& value;
    Range<double> range;
};

// The same of lists. That of the key which isn't given is empty.
struct ListAlternative {
    Key key;
    std::vector<double>& values;
    Range<double> range;
};

}  // namespace peterka::job
