// The location of a dataset's numbers in a file: contiguous, tile after tile if it is chunked.
//
// All storage of a map is allocated at creation, without filters, so that the place of each number follows from
// one address. A dataset stored in any other way has no Storage.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "hdf5/block.hpp"
#include "hdf5/checked.hpp"

namespace peterka::hdf5 {

class Storage {
  public:
    using Sizes = std::array<std::uint64_t, 3>;  // layers, rows, columns

    // Nothing for a dataset that is virtual, external, filtered, compact, not allocated or chunked with an
    // index that allows chunks at arbitrary addresses.
    [[nodiscard]] static std::optional<Storage> of(const Checked& check, hid_t dataset);

    [[nodiscard]] std::uint64_t begin() const { return address_; }
    [[nodiscard]] std::uint64_t end() const { return address_ + bytes_; }
    [[nodiscard]] bool is_chunked() const { return is_chunked_; }
    [[nodiscard]] bool is_scalar() const { return rank_ == 0; }
    [[nodiscard]] bool is_whole_chunk(const Block& block) const;
    [[nodiscard]] std::size_t bytes_per_value() const { return bytes_per_value_; }

    // Pieces of the file that hold a block, in the block's order.
    using Use = std::function<void(std::uint64_t offset, std::size_t bytes)>;
    void each_piece(const Block& block, const Use& use) const;
    // The whole dataset, tile by tile if it is chunked.
    void each_piece(const Use& use) const;

  private:
    [[nodiscard]] bool find_storage(hid_t dataset, hid_t properties);
    void each_piece(const Sizes& offset, const Sizes& count, const Use& use) const;

    bool is_chunked_ = false;
    std::uint64_t address_ = 0;
    std::uint64_t bytes_ = 0;  // in the file; chunks at the edge occupy the space of a whole one
    std::size_t bytes_per_value_ = 1;
    int rank_ = 0;
    Sizes size_{1, 1, 1};
    Sizes chunk_{1, 1, 1};
};

}  // namespace peterka::hdf5
