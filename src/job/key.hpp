// The description of a key or a table, used wherever it is read, requested or written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/range.hpp"

namespace peterka::job {

struct Key {
    std::string_view name;
    std::string_view meaning;             // with its unit in brackets
    std::string_view example = {};        // an example value of a required key; a key without one has a default
    bool is_identity = true;              // whether two runs that differ here are different jobs
    bool is_written = true;               // whether the resolved job holds it, or only what was read by it
    std::string_view example_in_si = {};  // in a job in SI units, where its keys or numbers are others there

    [[nodiscard]] bool is_required() const { return !example.empty(); }
};

// One of two keys of which exactly one is given, or neither if the first has a default.
struct Alternative {
    Key key;
    std::optional<double>& value;
    Range<double> range;
};

// The same for lists. The list whose key is not given is empty.
struct ListAlternative {
    Key key;
    std::vector<double>& values;
    Range<double> range;
};

}  // namespace peterka::job
