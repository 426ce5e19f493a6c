// One checksum over everything that is final in a file: the seal, /summary/checksum.
//
// XXH3 (64 bits) of a sequence of bytes that follows from what the file says, not from where in the file it
// lies; postprocess/peterka/files/seal.py makes the same one. Every text is preceded by its length, every
// number is a little-endian 64-bit integer. From the root, each group before what is in it, names in the order
// of their bytes, all but the group /run:
//     "group" or "dataset", path, number of attributes, and of each, in the order of their names' bytes, name,
//     type, shape (number of sizes, sizes) and bytes;
//     of a dataset also type, shape, along each dimension the number of scales and their paths, and its bytes,
//     tile by tile where it is chunked.
// The bytes of chunked datasets but /attractor are left out: /tiles/checksum, which is in, vouches for them. So
// are those of the seal itself, of /summary/finished, which is written after it, and of /summary/bytes, which
// vouches for itself (raw_bytes.hpp). Types are "i4", "u8", "f8",
// "S4096" for texts of fixed room, and "text". DIMENSION_LIST and REFERENCE_LIST are told by the scales.
//
// An unfinished map has a seal of its frame, /summary/frame: the same without the bytes of all datasets but
// lists at the root, its coordinates.
#pragma once

#include <hdf5.h>

#include <cstdint>

#include "hdf5/checked.hpp"
#include "hdf5/disk_file.hpp"

namespace peterka::map_file {

enum class Sealed {
    frame,  // what a map has from the beginning: all but the numbers of datasets that are no coordinates
    whole,
};

// Throws Failure(ExitCode::output) for what no file of this program holds. `disk`: where numbers are read from;
// null for a file that HDF5 makes.
[[nodiscard]] std::uint64_t seal_of(const hdf5::Checked& check, hid_t file, const hdf5::DiskFile* disk,
                                    Sealed part = Sealed::whole);

// Writes the seal into a file that HDF5 makes.
void write_seal(const hdf5::Checked& check, hid_t file, Sealed part);

// Whether the file on the disk is marked as finished.
[[nodiscard]] bool says_finished(const hdf5::Checked& check, hid_t file);

// Whether the file on the disk has the seal that belongs to it.
[[nodiscard]] bool is_sealed(const hdf5::Checked& check, hid_t file, Sealed part = Sealed::whole);

}  // namespace peterka::map_file
