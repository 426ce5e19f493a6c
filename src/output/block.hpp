// Raw numbers to and from a block of a dataset, by this rank alone.
//
// After the file has been made these are the only writes to it, and each is plain data at a place that is
// fixed.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "output/checked.hpp"
#include "output/variable.hpp"
#include "parallel/tiles.hpp"

namespace peterka::output {

// A rectangle of cells, a box on it, or a run of entries of a list.
class Block {
  public:
    explicit Block(const parallel::Tile& tile);
    Block(const parallel::Tile& tile, std::int64_t depth);  // with so many values for each cell
    Block(std::int64_t first, std::int64_t count);

    // Cut out of the dataset's own space.
    [[nodiscard]] const hsize_t* offset() const { return offset_.data(); }
    [[nodiscard]] const hsize_t* count() const { return count_.data(); }
    [[nodiscard]] int rank() const { return rank_; }

  private:
    int rank_;
    std::array<hsize_t, 3> offset_{};
    std::array<hsize_t, 3> count_{};
};

void write_block(const Checked& check, hid_t dataset, Number number, const Block& block, const void* values);
void read_block(const Checked& check, hid_t dataset, Number number, const Block& block, void* values);

// Scalars and texts by path.
void write_number(const Checked& check, hid_t file, const char* path, double value);
[[nodiscard]] double read_number(const Checked& check, hid_t file, const char* path);
void write_text(const Checked& check, hid_t file, const char* path, const std::string& text);

}  // namespace peterka::output
