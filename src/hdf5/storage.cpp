#include "hdf5/storage.hpp"

#include <algorithm>
#include <utility>

#include "hdf5/hdf5.hpp"

namespace peterka::hdf5 {

namespace {

using Sizes = std::array<std::uint64_t, 3>;

// A list is one row, a number one cell.
Sizes as_box(const hsize_t* sizes, int rank) {
    Sizes box{1, 1, 1};
    const int first = rank == 1 ? 1 : 0;
    std::copy_n(sizes, rank, box.begin() + first);
    return box;
}

// Hands on pieces as large as possible.
class Pieces {
  public:
    explicit Pieces(const Storage::Use& use) : use_(use) {}
    void add(std::uint64_t offset, std::uint64_t bytes) {
        if (offset == offset_ + bytes_) {
            bytes_ += bytes;
            return;
        }
        hand_on();
        offset_ = offset;
        bytes_ = bytes;
    }
    void hand_on() {
        if (bytes_ > 0) use_(offset_, static_cast<std::size_t>(std::exchange(bytes_, 0)));
    }

  private:
    const Storage::Use& use_;
    std::uint64_t offset_ = 0;
    std::uint64_t bytes_ = 0;
};

}  // namespace

std::optional<Storage> Storage::of(const Checked& check, hid_t dataset) {
    Storage storage;
    const PropertiesId properties(check(H5Dget_create_plist(dataset), "H5Dget_create_plist"));
    const SpaceId space(check(H5Dget_space(dataset), "H5Dget_space"));
    const TypeId type(check(H5Dget_type(dataset), "H5Dget_type"));
    storage.bytes_per_value_ = H5Tget_size(type.id());
    storage.rank_ = H5Sget_simple_extent_ndims(space.id());
    if (storage.rank_ < 0 || storage.rank_ > 3 || storage.bytes_per_value_ == 0) return std::nullopt;
    std::array<hsize_t, 3> sizes{};
    check(H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr), "H5Sget_simple_extent_dims");
    storage.size_ = as_box(sizes.data(), storage.rank_);
    if (H5Pget_nfilters(properties.id()) != 0 || H5Pget_external_count(properties.id()) != 0)
        return std::nullopt;
    if (!storage.find_storage(dataset, properties.id())) return std::nullopt;
    return storage;
}

bool Storage::find_storage(hid_t dataset, hid_t properties) {
    haddr_t address = HADDR_UNDEF;
    std::uint64_t values = 0;
    const H5D_layout_t layout = H5Pget_layout(properties);
    is_chunked_ = layout == H5D_CHUNKED;
    if (layout == H5D_CONTIGUOUS) {
        address = H5Dget_offset(dataset);
        chunk_ = size_;
    } else if (is_chunked_ && rank_ > 0) {
        std::array<hsize_t, 3> sides{};
        constexpr std::array<hsize_t, 3> corner{};
        H5D_chunk_index_t index = H5D_CHUNK_IDX_BTREE;
        if (H5Pget_chunk(properties, rank_, sides.data()) != rank_) return false;
        chunk_ = as_box(sides.data(), rank_);
        if (chunk_[2] != size_[2] || H5Dget_chunk_index_type(dataset, &index) < 0) return false;
        // of these alone one address tells all others
        if (index != H5D_CHUNK_IDX_NONE && index != H5D_CHUNK_IDX_SINGLE) return false;
        if (H5Dget_chunk_info_by_coord(dataset, corner.data(), nullptr, &address, nullptr) < 0) return false;
    } else {
        return false;
    }
    values = bytes_per_value_;
    for (std::size_t i = 0; i < 3; ++i) {
        if (chunk_[i] == 0) return false;
        const std::uint64_t chunks = (size_[i] + chunk_[i] - 1) / chunk_[i];
        if (__builtin_mul_overflow(values, chunks * chunk_[i], &values)) return false;
    }
    address_ = address;
    bytes_ = values;
    return address != HADDR_UNDEF && H5Dget_storage_size(dataset) == values && address + values > address;
}

void Storage::each_piece(const Block& block, const Use& use) const {
    const Sizes offset = as_box(block.offset(), block.rank());
    const Sizes count = as_box(block.count(), block.rank());
    const std::uint64_t first_row = block.rank() == 1 ? 0 : offset[0];
    const std::uint64_t chunks_across = (size_[1] + chunk_[1] - 1) / chunk_[1];
    const std::uint64_t cell = chunk_[2] * bytes_per_value_;
    Pieces pieces(use);
    for (std::uint64_t row = first_row; row < first_row + count[0]; ++row) {
        std::uint64_t column = offset[1];
        const std::uint64_t end = column + count[1];
        while (column < end) {
            const std::uint64_t border = (column / chunk_[1] + 1) * chunk_[1];
            const std::uint64_t next = std::min(border, end);
            const std::uint64_t chunk = row / chunk_[0] * chunks_across + column / chunk_[1];
            const std::uint64_t inside = row % chunk_[0] * chunk_[1] + column % chunk_[1];
            pieces.add(address_ + (chunk * chunk_[0] * chunk_[1] + inside) * cell, (next - column) * cell);
            column = next;
        }
    }
    pieces.hand_on();
}

void Storage::each_piece(const Use& use) const {
    if (!is_chunked_) return use(address_, static_cast<std::size_t>(bytes_));
    const auto side = [](std::uint64_t cells) { return static_cast<std::int64_t>(cells); };
    const parallel::Tiling tiling({side(size_[0]), side(size_[1])}, {side(chunk_[0]), side(chunk_[1])});
    for (std::int64_t i = 0; i < tiling.count(); ++i) each_piece(Block(tiling.tile(i)), use);
}

}  // namespace peterka::hdf5
