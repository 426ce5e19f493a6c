// Raw numbers to and from a block of a dataset through HDF5, by this rank alone.
//
// A map being computed is written and read through stored.hpp, which verifies it.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "hdf5/checked.hpp"
#include "hdf5/variable.hpp"
#include "parallel/tiles.hpp"

namespace peterka::hdf5 {

// A rectangle of cells, a box over it, or a range of entries of a list.
class Block {
  public:
    explicit Block(const parallel::Tile& tile);
    Block(const parallel::Tile& tile, std::int64_t depth);   // with `depth` values per cell
    Block(std::int64_t layers, const parallel::Tile& tile);  // `layers` planes of cells, one after the other
    Block(std::int64_t first, std::int64_t count);

    // Within the dataset's own dataspace.
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

// A text as stored in a file: truncated to its capacity, the rest zeros.
[[nodiscard]] std::array<char, text_capacity> padded_text(const std::string& text);

// Scalars and texts by path.
void write_number(const Checked& check, hid_t file, const char* path, double value);
[[nodiscard]] double read_number(const Checked& check, hid_t file, const char* path);
void write_text(const Checked& check, hid_t file, const char* path, const std::string& text);

}  // namespace peterka::hdf5
