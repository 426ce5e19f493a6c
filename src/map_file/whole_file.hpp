// A small file that is written once, as a whole, by a study or a trace: HDF5 in the conventions of map files.
//
// It is written under a temporary name in the same folder and then renamed, so under its own name there is a
// complete file or none. All functions throw Failure(ExitCode::output).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "map_file/provenance.hpp"
#include "map_file/run_facts.hpp"
#include "map_file/table.hpp"

namespace peterka::map_file {

// Checks, before anything is computed, that a file of this size can be made there, and that an existing file
// may be replaced.
void require_place(const std::filesystem::path& path, std::int64_t largest_bytes);

// An additional text at the root of the file.
struct RootText {
    const char* name;
    std::string text;
};

// The results of one run: its datasets, in the order of the file (a scale before the datasets that use it).
struct Contents {
    std::vector<RootText> texts;
    std::vector<Table> tables;
};

void write_whole_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                      const Contents& contents, const RunFacts& facts);

}  // namespace peterka::map_file
