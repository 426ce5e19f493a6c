// One cell of a finished or unfinished map or basin file, as the file stores it, with the job that made it.
//
// Serial. Nothing is trusted that does not match the layout of the job in the file, and the cell's tile must
// match its checksum. Throws Failure(ExitCode::bad_job) that names the file, what is wrong with it, and what to
// do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "quantities/fields.hpp"

namespace peterka::map_file {

struct MapCell {
    std::filesystem::path file;
    std::int64_t row = 0;
    std::int64_t column = 0;
    job::Job job;                     // of the map
    quantities::StoredCell stored{};  // in the units of the file
    std::string asked_beside{};       // its distance from the place of the trace; "" if there is none
};

// The job that a map or basin file stores. `key`: the key of the requesting job that names the file.
[[nodiscard]] job::Job read_map_job(const std::filesystem::path& path, const std::string& key);

// A cell of that job's plane.
[[nodiscard]] MapCell read_map_cell(const std::filesystem::path& path, const job::Job& job, std::int64_t row,
                                    std::int64_t column);

}  // namespace peterka::map_file
