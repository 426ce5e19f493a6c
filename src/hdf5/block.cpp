#include "hdf5/block.hpp"

#include <algorithm>
#include <array>

#include "hdf5/hdf5.hpp"
#include "support/whole_letters.hpp"

namespace peterka::hdf5 {

namespace {

SpaceId space_in_memory(const Checked& check, const Block& block) {
    return SpaceId(check(H5Screate_simple(block.rank(), block.count(), nullptr), "H5Screate_simple"));
}

SpaceId space_in_file(const Checked& check, hid_t dataset, const Block& block) {
    SpaceId space(check(H5Dget_space(dataset), "H5Dget_space"));
    check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, block.offset(), nullptr, block.count(), nullptr),
          "H5Sselect_hyperslab");
    return space;
}

DatasetId open_dataset(const Checked& check, hid_t file, const char* path) {
    return DatasetId(check(H5Dopen2(file, path, H5P_DEFAULT), "H5Dopen2"));
}

// The last byte is reserved for 0.
std::size_t length_that_fits(const std::string& text) {
    return whole_letters(text, text_capacity - 1);
}

}  // namespace

Block::Block(const parallel::Tile& tile)
    : rank_(2),
      offset_{static_cast<hsize_t>(tile.row), static_cast<hsize_t>(tile.column)},
      count_{static_cast<hsize_t>(tile.extent.rows), static_cast<hsize_t>(tile.extent.columns)} {}

Block::Block(const parallel::Tile& tile, std::int64_t depth) : Block(tile) {
    rank_ = 3;
    count_[2] = static_cast<hsize_t>(depth);
}

Block::Block(std::int64_t layers, const parallel::Tile& tile)
    : rank_(3),
      offset_{0, static_cast<hsize_t>(tile.row), static_cast<hsize_t>(tile.column)},
      count_{static_cast<hsize_t>(layers), static_cast<hsize_t>(tile.extent.rows),
             static_cast<hsize_t>(tile.extent.columns)} {}

Block::Block(std::int64_t first, std::int64_t count)
    : rank_(1), offset_{static_cast<hsize_t>(first)}, count_{static_cast<hsize_t>(count)} {}

void write_block(const Checked& check, hid_t dataset, Number number, const Block& block, const void* values) {
    check(H5Dwrite(dataset, memory_type(number), space_in_memory(check, block).id(),
                   space_in_file(check, dataset, block).id(), H5P_DEFAULT, values),
          "H5Dwrite");
}

void read_block(const Checked& check, hid_t dataset, Number number, const Block& block, void* values) {
    check(H5Dread(dataset, memory_type(number), space_in_memory(check, block).id(),
                  space_in_file(check, dataset, block).id(), H5P_DEFAULT, values),
          "H5Dread");
}

void write_number(const Checked& check, hid_t file, const char* path, double value) {
    const DatasetId dataset = open_dataset(check, file, path);
    check(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value), "H5Dwrite");
}

double read_number(const Checked& check, hid_t file, const char* path) {
    const DatasetId dataset = open_dataset(check, file, path);
    const SpaceId one(check(H5Screate(H5S_SCALAR), "H5Screate"));  // reading fails if more are stored
    double value = 0;
    check(H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, one.id(), H5S_ALL, H5P_DEFAULT, &value), "H5Dread");
    return value;
}

std::array<char, text_capacity> padded_text(const std::string& text) {
    std::array<char, text_capacity> room{};
    std::copy_n(text.begin(), length_that_fits(text), room.begin());
    return room;
}

void write_text(const Checked& check, hid_t file, const char* path, const std::string& text) {
    const DatasetId dataset = open_dataset(check, file, path);
    const TypeId type = file_type(check, Number::text);
    check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded_text(text).data()),
          "H5Dwrite");
}

}  // namespace peterka::hdf5
