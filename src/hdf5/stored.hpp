// A dataset of an open map: its numbers are written through HDF5 and read from disk by system calls. Every
// write is read back, since MPI-IO may hide a failed or short one. What it didn't write is written by a system
// call, which succeeds or reports the reason.
//
// The writes are this rank's own, of plain data at fixed places. The HDF5 file must have been opened with
// file_access() or in parallel, so that nothing is held back in memory. All functions throw
// Failure(ExitCode::output).
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hdf5/block.hpp"
#include "hdf5/checked.hpp"
#include "hdf5/disk_file.hpp"
#include "hdf5/hdf5.hpp"
#include "hdf5/storage.hpp"
#include "hdf5/variable.hpp"

namespace peterka::hdf5 {

// A file opened by HDF5 and by system calls; both must outlive the datasets made from them.
struct OpenMap {
    const Checked& check;
    hid_t file;
    const DiskFile& disk;
};

class Stored {
  public:
    Stored(const OpenMap& map, const std::string& path, Number number);

    void write(const Block& block, const void* values) const;
    void read(const Block& block, void* values) const;

    [[nodiscard]] Number number() const { return number_; }
    [[nodiscard]] std::size_t bytes(const Block& block) const;

  private:
    [[nodiscard]] bool hand_over(const Block& block, const void* values) const;  // whether HDF5 accepted them
    [[nodiscard]] bool holds(const Block& block, std::span<const std::byte> values) const;

    OpenMap map_;
    std::string path_;
    Number number_;
    DatasetId dataset_;
    Storage storage_;
};

// Scalars and texts by path.
void put_number(const OpenMap& map, const char* path, Number number, double value);
[[nodiscard]] double get_number(const OpenMap& map, const char* path, Number number);
void put_text(const OpenMap& map, const char* path, const std::string& text);

}  // namespace peterka::hdf5
