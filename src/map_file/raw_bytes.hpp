// One checksum over a file's raw bytes, looked at before HDF5 opens the file: HDF5 believes what it reads of
// texts and references, and damage there would crash it, or have it read for ever.
//
// The last 4096 bytes of a file are the dataset /summary/bytes, the record: a text,
//     peterka bytes 1, XXH3 0123456789abcdef
//     4711 8807
//     8000000 8004096
// and zeros. Its ranges, from the first byte to the one behind the last, in order, are what is not summed: the
// numbers of a map, which change while it is computed and have checksums of their own (seal.hpp), and, last of
// all, the record itself. The sum is that of the record from its second line to its end, and then of all bytes
// of the file outside the ranges. All of this is final when a file is made. postprocess/peterka/files/
// raw_bytes.py reads the same.
//
// Files of layout 2 have no record, and one that another program has written anew has it elsewhere: what HDF5
// makes of those is tried by a process of its own first.
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

// Gives what the file has from an offset on; throws where it can't.
using ReadBytes = std::function<void(std::uint64_t offset, std::span<std::byte> bytes)>;

// The place of the record in a file of this size.
[[nodiscard]] ByteRange place_of_record(std::uint64_t file_size);

// The record of a file; `numbers` are left out, in any order.
[[nodiscard]] std::string record_for(std::uint64_t file_size, std::vector<ByteRange> numbers,
                                     const ReadBytes& read);

// Whether the bytes are those that the record was made of; nothing where no record is at the end.
[[nodiscard]] std::optional<bool> are_sound(std::uint64_t file_size, const ReadBytes& read);

// Where the numbers of these datasets lie, of a file that HDF5 has open. The record has to be its end.
[[nodiscard]] std::vector<ByteRange> ranges_of(const hdf5::Checked& check, hid_t file,
                                               std::span<const DatasetPlan> plans);

// Gives a file that is whole and closed its record.
void write_record(const std::filesystem::path& path, std::vector<ByteRange> numbers);

// Whether the file ends with a record, and its bytes are not those that it was made of.
[[nodiscard]] bool are_broken(const std::filesystem::path& path);

// Why HDF5 must not open the file, as in "FILE: is damaged: ..."; empty where it may.
[[nodiscard]] std::string fault_in_bytes(const hdf5::Checked& check);

}  // namespace peterka::map_file
