#include "hdf5/storage.hpp"

#include <algorithm>
#include <utility>

#include "hdf5/hdf5.hpp"

namespace peterka::hdf5 {

namespace {

using Sizes = Storage::Sizes;

// A plane is one layer, a list one row of a layer, a number one cell.
Sizes as_box(const hsize_t* sizes, int rank, std::uint64_t lacking) {
    Sizes box;
    box.fill(lacking);
    std::copy_n(sizes, rank, box.end() - rank);
    return box;
}

// Calls use(layer, row) for each row of a box.
template <class UseRow>
void each_row(const Sizes& offset, const Sizes& count, const UseRow& use_row) {
    for (std::uint64_t layer = offset[0]; layer < offset[0] + count[0]; ++layer) {
        for (std::uint64_t row = offset[1]; row < offset[1] + count[1]; ++row) use_row(layer, row);
    }
}

// Merges adjacent pieces before passing them on.
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
    storage.size_ = as_box(sizes.data(), storage.rank_, 1);
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
        chunk_ = as_box(sides.data(), rank_, 1);
        if (H5Dget_chunk_index_type(dataset, &index) < 0) return false;
        // only for these does one address determine all others
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

bool Storage::is_whole_chunk(const Block& block) const {
    if (!is_chunked_ || block.rank() != rank_) return false;
    const Sizes offset = as_box(block.offset(), rank_, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        if (offset[i] % chunk_[i] != 0) return false;
    }
    return as_box(block.count(), rank_, 1) == chunk_;
}

void Storage::each_piece(const Block& block, const Use& use) const {
    each_piece(as_box(block.offset(), block.rank(), 0), as_box(block.count(), block.rank(), 1), use);
}

void Storage::each_piece(const Sizes& offset, const Sizes& count, const Use& use) const {
    const auto chunks = [&](std::size_t i) { return (size_[i] + chunk_[i] - 1) / chunk_[i]; };
    const std::uint64_t chunk_size = chunk_[0] * chunk_[1] * chunk_[2];
    Pieces pieces(use);
    each_row(offset, count, [&](std::uint64_t layer, std::uint64_t row) {
        const std::uint64_t chunk_row = layer / chunk_[0] * chunks(1) + row / chunk_[1];
        const std::uint64_t inside_row = layer % chunk_[0] * chunk_[1] + row % chunk_[1];
        std::uint64_t column = offset[2];
        const std::uint64_t end = column + count[2];
        while (column < end) {
            const std::uint64_t border = (column / chunk_[2] + 1) * chunk_[2];
            const std::uint64_t next = std::min(border, end);
            const std::uint64_t chunk = chunk_row * chunks(2) + column / chunk_[2];
            const std::uint64_t inside = inside_row * chunk_[2] + column % chunk_[2];
            pieces.add(address_ + (chunk * chunk_size + inside) * bytes_per_value_,
                       (next - column) * bytes_per_value_);
            column = next;
        }
    });
    pieces.hand_on();
}

void Storage::each_piece(const Use& use) const {
    if (!is_chunked_) return use(address_, static_cast<std::size_t>(bytes_));
    Sizes corner{};
    const auto count = [&](std::size_t i) { return std::min(chunk_[i], size_[i] - corner[i]); };
    for (corner[0] = 0; corner[0] < size_[0]; corner[0] += chunk_[0]) {
        for (corner[1] = 0; corner[1] < size_[1]; corner[1] += chunk_[1]) {
            for (corner[2] = 0; corner[2] < size_[2]; corner[2] += chunk_[2]) {
                each_piece(corner, {count(0), count(1), count(2)}, use);
            }
        }
    }
}

}  // namespace peterka::hdf5
