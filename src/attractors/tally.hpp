// The attractors on which the starts of a cell end, and the number of starts on each.
//
// All chaotic results count as one attractor, and so do all unresolved and all failed ones. The first start
// that ends on an attractor represents it, so starts are added in their order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"

namespace peterka::attractors {

class Tally {
  public:
    static constexpr std::int64_t no_start = -1;  // none but [start]

    struct Entry {
        regime::CellResult result;                    // of the first start
        std::optional<regime::FoundAttractor> orbit;  // the orbit of `result`, with the map on which it is one
        std::int64_t starts = 0;
        std::int64_t first = 0;  // the first of these starts
    };

    // The entry of [start], which is not counted. found: what its search ended on.
    [[nodiscard]] static Entry entry_of(const regime::CellResult& result,
                                        std::span<const regime::FoundAttractor> found);

    // found: what the search of this start ended on.
    void add(const regime::CellResult& result, std::span<const regime::FoundAttractor> found);

    // In the order of the file: by share, then regime, q, p and force.
    [[nodiscard]] std::vector<Entry> in_order() const;

  private:
    std::vector<Entry> entries_;
    std::int64_t added_ = 0;
};

// The first entry that a result belongs to; -1 for none.
[[nodiscard]] std::int32_t slot_of(std::span<const Tally::Entry> entries, const regime::CellResult& result);

// Keeps at most `most`: those with the largest shares, and `own`, the motion on which [start] ends, in the last
// place if it is not among these and most > 1.
void keep_most(std::vector<Tally::Entry>& ordered, const Tally::Entry& own, std::size_t most);

[[nodiscard]] CellAttractor as_attractor(const Tally::Entry& entry, std::int64_t all_starts);
// A known attractor on which no start ended.
[[nodiscard]] CellAttractor without_share(const regime::CellResult& result);

}  // namespace peterka::attractors
