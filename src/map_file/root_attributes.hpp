// The attributes at a map file's root: format, job, scales for plots in SI units, and provenance.
#pragma once

#include <hdf5.h>

#include "hdf5/checked.hpp"
#include "job/job.hpp"
#include "map_file/provenance.hpp"

namespace peterka::map_file {

namespace attribute {
inline constexpr const char* layout = "peterka_layout";
inline constexpr const char* kind = "peterka_kind";
inline constexpr const char* job = "job";
inline constexpr const char* job_identity = "job_identity";
inline constexpr const char* arithmetic = "arithmetic";
inline constexpr const char* sundials = "sundials_version";
}  // namespace attribute

void write_root_attributes(const hdf5::Checked& check, hid_t file, const job::Job& job,
                           const Provenance& provenance);

}  // namespace peterka::map_file
