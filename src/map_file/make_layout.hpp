// Fills an empty HDF5 file with the datasets and scales of a map.
//
// All space is allocated and filled here and all datasets have fixed sizes, so no later write changes metadata.
#pragma once

#include <hdf5.h>

#include <span>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"
#include "job/job.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

// Properties of files of this layout: how objects are encoded, so that HDF5 1.10 and newer can open them.
[[nodiscard]] hdf5::PropertiesId file_access(const hdf5::Checked& check);
[[nodiscard]] hdf5::PropertiesId file_creation(const hdf5::Checked& check);

// The plans include that of the record of bytes, which becomes the end of the file.
void make_datasets(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans);
void write_coordinates(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans,
                       const job::Job& job);
// Whether a coordinate dataset holds the job's coordinates; it must have the plan's type and size.
[[nodiscard]] bool holds_coordinates(const hdf5::Checked& check, hid_t file, const DatasetPlan& plan,
                                     const job::Job& job);

}  // namespace peterka::map_file
