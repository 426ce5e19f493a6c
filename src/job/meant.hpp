// The key that is meant by an unknown one, told with its unit where the unknown one has another: gap_m for
// gap_mm.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace peterka::job {

struct Meant {
    std::string_view key;   // empty if none is near enough
    std::string_view unit;  // "in metres"; empty where the unknown key has the same, or none
    [[nodiscard]] bool found() const { return !key.empty(); }
    // "did you mean [gap_m], in metres?" for brackets [ and ]
    [[nodiscard]] std::string question(std::string_view before = "", std::string_view after = "") const;
};

// The same quantity in another unit, or the nearest name (nearest.hpp).
[[nodiscard]] Meant meant_by(std::string_view unknown, const std::vector<std::string_view>& known);

}  // namespace peterka::job
