// The file of a study: HDF5 in the conventions of map files, written once, whole.
//
// It is written under a temporary name in the same folder and then renamed, so under its own name there is a
// complete study or none. All functions throw Failure(ExitCode::output).
#pragma once

#include <filesystem>
#include <span>

#include "job/job.hpp"
#include "output/provenance.hpp"
#include "output/run_facts.hpp"
#include "study/table.hpp"

namespace peterka::study {

// Before anything is computed: whether a file can be made there, and what lies there may be replaced.
void require_place(const std::filesystem::path& path);

void write_study(const std::filesystem::path& path, const job::Job& job, const output::Provenance& provenance,
                 std::span<const Table> tables, const output::RunFacts& facts);

}  // namespace peterka::study
