// One checksum over a file's raw bytes, verified before HDF5 opens the file: HDF5 trusts the texts and
// references that it reads, and damage there would crash it or make it read forever.
//
// The last 4096 bytes of a file are the dataset /summary/bytes, the record: a text,
//     peterka bytes 1, XXH3 0123456789abcdef
//     4711 8807
//     8000000 8004096
// and zeros. Its ranges, half-open and in order, are excluded from the sum: the numbers of a map, which change
// while it is computed and have checksums of their own (seal.hpp), and, last, the record itself. The sum covers
// the record from its second line to its end, and then all bytes of the file outside the ranges. All of this is
// final when a file is made. postprocess/peterka/files/raw_bytes.py reads the same format.
//
// Files of layout 2 have no record, and a file rewritten by another program has it elsewhere: these are first
// opened by a separate process (trial.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hdf5/checked.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

struct ByteRange {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    friend bool operator==(const ByteRange&, const ByteRange&) = default;
};

// Reads the file's bytes from an offset on; throws on failure.
using ReadBytes = std::function<void(std::uint64_t offset, std::span<std::byte> bytes)>;

// The place of the record in a file of this size.
[[nodiscard]] ByteRange place_of_record(std::uint64_t file_size);

// The record of a file, excluding the ranges `numbers`, given in any order.
[[nodiscard]] std::string record_for(std::uint64_t file_size, std::vector<ByteRange> numbers,
                                     const ReadBytes& read);

// Whether the bytes match the record; nothing if there is no record at the end.
[[nodiscard]] std::optional<bool> are_sound(std::uint64_t file_size, const ReadBytes& read);

// The byte ranges of these datasets' numbers in a file that HDF5 has open. The record must be its end.
[[nodiscard]] std::vector<ByteRange> ranges_of(const hdf5::Checked& check, hid_t file,
                                               std::span<const DatasetPlan> plans);

// Writes the record of a complete, closed file.
void write_record(const std::filesystem::path& path, std::vector<ByteRange> numbers);

// Whether the file ends with a record that its bytes do not match.
[[nodiscard]] bool are_broken(const std::filesystem::path& path);

// Why HDF5 must not open the file, as in "FILE: is damaged: ..."; empty if it may.
[[nodiscard]] std::string fault_in_bytes(const hdf5::Checked& check);

}  // namespace peterka::map_file
