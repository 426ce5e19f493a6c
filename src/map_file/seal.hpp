// One checksum over everything that is final in a file: the seal, /summary/checksum.
//
// XXH3 (64 bits) of a byte sequence that follows from the contents of the file, not from their location in it;
// postprocess/peterka/files/seal.py computes the same one. Every text is preceded by its length, every number
// is a little-endian 64-bit integer. From the root, each group before its members, names in byte order, all
// except the group /run:
//     "group" or "dataset", path, number of attributes, and for each, in byte order of their names, name,
//     type, shape (number of sizes, sizes) and bytes;
//     for a dataset also type, shape, along each dimension the number of scales and their paths, and its bytes,
//     tile by tile where it is chunked.
// The bytes of chunked datasets except /attractor are left out: /tiles/checksum, which is included, covers
// them. So are those of the seal itself, of /summary/finished, which is written after it, and of
// /summary/bytes, which has its own checksum (raw_bytes.hpp). Types are "i4", "u8", "f8",
// "S4096" for texts of fixed length, and "text". DIMENSION_LIST and REFERENCE_LIST are represented by the
// scales.
//
// An unfinished map has a seal of its frame, /summary/frame: the same without the bytes of all datasets except
// one-dimensional ones at the root, its coordinates.
#pragma once

#include <hdf5.h>

#include <cstdint>

#include "hdf5/checked.hpp"
#include "hdf5/disk_file.hpp"

namespace peterka::map_file {

enum class Sealed {
    frame,  // what a map has from the beginning: all but the numbers of non-coordinate datasets
    whole,
};

// Throws Failure(ExitCode::output) for content that no file of this program has. `disk`: where numbers are read
// from; null for a file that HDF5 is creating.
[[nodiscard]] std::uint64_t seal_of(const hdf5::Checked& check, hid_t file, const hdf5::DiskFile* disk,
                                    Sealed part = Sealed::whole);

// Writes the seal into a file that HDF5 is creating.
void write_seal(const hdf5::Checked& check, hid_t file, Sealed part);

// Whether the file on the disk is marked as finished.
[[nodiscard]] bool says_finished(const hdf5::Checked& check, hid_t file);

// Whether the seal of the file on the disk matches its contents.
[[nodiscard]] bool is_sealed(const hdf5::Checked& check, hid_t file, Sealed part = Sealed::whole);

}  // namespace peterka::map_file
